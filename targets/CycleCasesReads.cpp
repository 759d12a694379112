// Common variables that a posted program reads and never writes: a value of the shop, the same on both sides.
#include "ir/Walk.h"
#include "targets/CycleCasesParts.h"
#include "targets/Target.h"
#include "verify/Random.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace dotek::targets {

namespace {

constexpr double kFirst = 100, kEnd = 1000; // common variables
// Cases that come to nothing, until the variables hold in turn what a shop keeps for certain: the ball's
// radius, its diameter, or nothing.
constexpr std::uint32_t kInVain = 2;

bool readsCommon(const ir::Program& program) {
  return std::any_of(program.body.begin(), program.body.end(), [](const ir::ProgramStatement& statement) {
    bool found = false;
    ir::eachNode(statement, [&](const ir::Expression& node) {
      const auto* use = std::get_if<ir::MachineVariable>(&node.node);
      const double* number = use == nullptr ? nullptr : ir::constantValue(use->number);
      found = found || (number != nullptr && *number >= kFirst && *number < kEnd);
    });
    return found;
  });
}

} // namespace

void CaseRunner::findReads(Values& values) {
  Posted& posted = *values.posted;
  if (!readsCommon(posted.file.programs.front())) return;
  std::vector<const stdlib::MacroSet*> sets;
  if (sourceSet_ != nullptr) sets.push_back(sourceSet_);
  posted.reads = verify::variablesOf(posted.file, *inputs_->sourceControl, sets);
  const stdlib::MacroSet* const other =
      session_.macroSet(plan_.targetMacros, inputs_->control ? &*inputs_->control : nullptr);
  std::erase_if(posted.reads, [&](const verify::ProgramVariable& one) {
    if (one.number < kFirst || one.number >= kEnd) return true;
    // What the macros of a set leave there is theirs.
    if (sourceSet_ != nullptr && verify::usesVariable(*sourceSet_, one.number)) return true;
    return other != nullptr && verify::usesVariable(*other, one.number) &&
           !verify::needsVariable(*other, one.number);
  });
  // What the macros of the translation want both sides read.
  const double radius = values.drawn.hosts.at("tool_radius");
  for (const verify::ProgramVariable& one : posted.reads)
    if (other != nullptr && verify::needsVariable(*other, one.number) && !isGiven(one.number))
      if (const auto value = verify::presetOf(*other, one.number, radius))
        values.presets[one.number] = *value;
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
