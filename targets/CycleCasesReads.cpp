// Common variables that a posted program reads and never writes: a value of the shop, the same on both sides.
#include "ir/Match.h"
#include "ir/Walk.h"
#include "targets/CycleCasesParts.h"
#include "targets/Target.h"
#include "verify/Random.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <map>

namespace dotek::targets {

namespace {

constexpr double kFirst = 100, kFirstKept = 500, kEnd = 1000; // common variables
// Cases that come to nothing, until the variables hold in turn what a shop keeps for certain: the ball's
// radius, its diameter, or nothing.
constexpr std::uint32_t kInVain = 2;

// The variable that holds the last T; 0: the control has none.
std::uint32_t wordOfTool(const stdlib::Control& control) {
  constexpr int kLetter = 20;
  return control.variables.modalWords ? static_cast<std::uint32_t>(*control.variables.modalWords + kLetter)
                                      : 0;
}

// Of the common variables that are read by number.
template <class Wanted> bool reads(const ir::Program& program, const Wanted& wanted) {
  return std::any_of(program.body.begin(), program.body.end(), [&](const ir::ProgramStatement& statement) {
    bool found = false;
    ir::eachNode(statement, [&](const ir::Expression& node) {
      const auto* use = std::get_if<ir::MachineVariable>(&node.node);
      const double* number = use == nullptr ? nullptr : ir::constantValue(use->number);
      found = found || (number != nullptr && *number >= kFirst && *number < kEnd &&
                        wanted(static_cast<std::uint32_t>(*number)));
    });
    return found;
  });
}

// What the machine alone knows and the branch compares with a number, by variable: the tool in the spindle
// (#4120), a signal. The first number of each.
std::map<std::uint32_t, double> asksMachine(const ir::Program& program, const stdlib::Control& control) {
  std::map<std::uint32_t, double> out;
  const auto ofMachine = [&](std::uint32_t number) {
    if (number == wordOfTool(control)) return true;
    return std::any_of(control.state.begin(), control.state.end(), [&](const stdlib::StateRange& range) {
      return range.first <= number && number <= range.last && !range.initial && !range.null &&
             range.access == stdlib::StateRange::Access::ReadOnly;
    });
  };
  const std::function<void(const ir::ConditionPtr&)> look = [&](const ir::ConditionPtr& condition) {
    ir::match(
        *condition,
        [&](const ir::Comparison& node) {
          const auto* use = std::get_if<ir::MachineVariable>(&node.left->node);
          const double* number = use == nullptr ? nullptr : ir::constantValue(use->number);
          const double* value = ir::constantValue(node.right);
          if (number != nullptr && value != nullptr && *number >= kEnd && *number < 1e6 &&
              ofMachine(static_cast<std::uint32_t>(*number)))
            out.emplace(static_cast<std::uint32_t>(*number), *value);
        },
        [&](const ir::Not& node) { look(node.inner); },
        [&](const ir::Junction& node) {
          look(node.left);
          look(node.right);
        },
        [](const ir::OneOf<ir::IsNull, ir::Truth> auto&) {});
  };
  for (const ir::ProgramStatement& statement : program.body)
    if (const auto* branch = std::get_if<ir::Branch>(&statement.node)) look(branch->condition);
  return out;
}

} // namespace

void CaseRunner::findReads(Values& values) {
  Posted& posted = *values.posted;
  const ir::Program& program = posted.file.programs.front();
  // What is asked for is so, until cases come to nothing: then in turns it is not.
  for (const auto& [number, value] : asksMachine(program, *inputs_->sourceControl))
    if (!isGiven(number)) values.presets[number] = others_ % 2 == 0 ? value : value == 0 ? 1 : 0;
  if (!reads(program, [](std::uint32_t) { return true; })) return;
  std::vector<const stdlib::MacroSet*> sets;
  if (sourceSet_ != nullptr) sets.push_back(sourceSet_);
  posted.reads = verify::variablesOf(posted.file, *inputs_->sourceControl, sets);
  const stdlib::MacroSet* const other =
      session_.macroSet(plan_.targetMacros, inputs_->control ? &*inputs_->control : nullptr);
  std::erase_if(posted.reads, [&](const verify::ProgramVariable& one) {
    if (one.number < kFirst || one.number >= kEnd) return true;
    // What the macros of a set leave there is theirs.
    if (sourceSet_ != nullptr && verify::usesVariable(*sourceSet_, one.number)) return true;
    return other != nullptr && one.number < kFirstKept && verify::usesVariable(*other, one.number) &&
           !verify::needsVariable(*other, one.number);
  });
  const double radius = values.drawn.hosts.at("tool_radius");
  // A branch that looks at the calibration meets a probe that is calibrated.
  const bool looks = sourceSet_ != nullptr && reads(program, [&](std::uint32_t number) {
                       return verify::needsVariable(*sourceSet_, number);
                     });
  if (looks) {
    const auto preset = [&](const std::optional<std::uint32_t>& number, double value) {
      if (number && !isGiven(*number)) values.presets[*number] = value;
    };
    const stdlib::ProbingFacts& facts = sourceSet_->probing;
    preset(facts.radiusX, radius);
    preset(facts.radiusY, radius);
    preset(facts.offsetX, 0);
    preset(facts.offsetY, 0);
    for (std::uint32_t at = facts.vectorFirst.value_or(1); at <= facts.vectorLast.value_or(0); ++at)
      preset(at, radius);
  }
  // What the macros of the translation want both sides read.
  for (const verify::ProgramVariable& one : posted.reads)
    if (other != nullptr && verify::needsVariable(*other, one.number) && !isGiven(one.number))
      if (const auto value = verify::presetOf(*other, one.number, radius))
        values.presets[one.number] = *value;
}

// Of an earlier call, or of another program: what starts a counter has to do it on the other side, too.
void CaseRunner::findLeftOver(Values& values) {
  const auto used = [&](const stdlib::MacroSet* set, std::uint32_t number) {
    return set != nullptr && (verify::usesVariable(*set, number) || verify::needsVariable(*set, number));
  };
  const stdlib::MacroSet* const other =
      session_.macroSet(plan_.targetMacros, inputs_->control ? &*inputs_->control : nullptr);
  values.posted->leftOver = values.posted->stores;
  std::erase_if(values.posted->leftOver, [&](std::uint32_t number) {
    return isGiven(number) || values.presets.contains(number) || used(sourceSet_, number) ||
           used(other, number) ||
           std::any_of(values.posted->reads.begin(), values.posted->reads.end(),
                       [&](const verify::ProgramVariable& one) { return one.number == number; });
  });
}

bool CaseRunner::isGiven(std::uint32_t variable) const {
  return std::any_of(variables_.begin(), variables_.end(),
                     [&](const auto& given) { return given.first == variable; });
}

// Mostly a ball, which shops keep there, else as for programs, or nothing: a cycle that looks at what it has
// measured stops with most values.
void CaseRunner::drawVariables(Values& values) {
  constexpr double kNothing = 0.3, kBall = 0.6, kOff = 0.2;
  verify::Case& drawn = values.drawn;
  const double radius = drawn.hosts.at("tool_radius");
  for (const verify::ProgramVariable& one : values.posted->reads) {
    if (isGiven(one.number) || values.presets.contains(one.number)) continue;
    verify::Random random(
        verify::Random::sub(drawn.stream, verify::Random::hash(fmt::format("#{}", one.number))));
    const bool length = one.use == verify::VariableUse::Length || one.use == verify::VariableUse::Size;
    if (others_ > kInVain) {
      const std::uint32_t turn = others_ % 4; // the radius twice as often
      if (length && turn != 0)
        drawn.variables[one.number] = std::round(radius * (turn == 2 ? 2 : 1) * 1000) / 1000;
      continue;
    }
    // Beside its path the post has what a shop keeps there, or nothing.
    if (target_ == nullptr || random.chance(kNothing)) continue;
    if (length && random.chance(kBall))
      drawn.variables[one.number] = std::round(radius * random.between(1 - kOff, 1 + kOff) * 1000) / 1000;
    else if (const auto value = verify::drawValue(one, 0, random))
      drawn.variables[one.number] = std::round(*value * 1000) / 1000;
  }
}

} // namespace dotek::targets
