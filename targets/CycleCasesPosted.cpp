// What the posted program of a case says of its values and macros.
#include "ir/Walk.h"
#include "targets/CycleCasesParts.h"
#include "targets/Stage.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dotek::targets {

// Values that are printed through others, as half of a diameter, with no more digits than the post prints:
// multiples of `unit`.
verify::Case CaseRunner::coarser(verify::Case drawn, double unit) const {
  const auto coarsen = [&](double& value, double least) {
    value = std::max(least, std::round(value / unit) * unit + 0.0);
  };
  for (const verify::DrawField& field : plan_.fields) {
    const bool measured = field.kind == ir::Kind::Length || field.kind == ir::Kind::Number ||
                          field.kind == ir::Kind::Angle || field.kind == ir::Kind::Ratio;
    if (!field.fixed && measured && field.choices.empty())
      coarsen(drawn.values[field.name], -std::numeric_limits<double>::max());
  }
  for (const char* host : {"tool_radius", "overtravel", "start_x", "start_y"})
    if (const auto value = drawn.hosts.find(host);
        value != drawn.hosts.end() && !plan_.fixedHosts.contains(host))
      coarsen(value->second, std::string_view(host).starts_with("start") ? -1e9 : unit);
  return drawn;
}

// The proposal, or where the post drops digits of it a coarser one. nullptr: the values are rejected;
// refusal_ says why.
std::unique_ptr<CaseRunner::Values> CaseRunner::attempt(const verify::Case& proposal) {
  rests_ = false;
  std::unique_ptr<Values> out = attemptAsIs(proposal);
  for (const double unit : {0.02, 0.2, 2.0}) {
    // A target that writes a program for each case gets its values from the source.
    if (!out || !out->losesDigits || (target_ != nullptr && !plan_.translation)) return out;
    out = attemptAsIs(coarser(proposal, unit));
  }
  if (!out || !out->losesDigits) return out;
  // A cosine, or a third: both sides get it in full.
  rests_ = true;
  out = attemptAsIs(proposal);
  rests_ = false;
  if (!out || !out->losesDigits) return out;
  // What the post drops of all values is a difference from the path.
  if (target_ == nullptr) return attemptAsIs(proposal);
  refusal_ = "the post prints fewer digits than these values have";
  refusedAt_ = {};
  return nullptr;
}

// A call spaces its touches by a length whose half lies between two steps of the control: macros that come to
// these places by words round it, others may not.
bool CaseRunner::halvesBetweenSteps(const ir::Program& program) const {
  constexpr double kSame = 1e-6;
  const double steps = std::pow(10, inputs_->sourceControl->decimals); // in a mm
  for (const ir::ProgramStatement& statement : program.body) {
    const auto* call = std::get_if<ir::Call>(&statement.node);
    const double* number = call != nullptr && call->program ? ir::constantValue(call->program) : nullptr;
    if (number == nullptr || !(*number >= 1 && *number < 1e8)) continue;
    const auto called = static_cast<std::uint32_t>(std::lround(*number));
    for (const stdlib::MacroSignature& signature : sourceSet_->signatures) {
      if (signature.program != called) continue;
      for (const stdlib::MacroArgument& argument : signature.arguments) {
        if (argument.role != stdlib::ArgumentRole::Spacing) continue;
        for (const ir::CallArgument& given : call->arguments) {
          const double* value = given.letter == argument.letter ? ir::constantValue(given.value) : nullptr;
          if (value == nullptr) continue;
          const double half = *value / 2 * steps;
          if (std::abs(half - std::round(half)) > kSame) return true;
        }
      }
    }
  }
  return false;
}

// Places between two steps of the control, to which other macros, a fragment's formats and the control come
// by rounded words. `byWords`: such macros are compared, or the path.
double CaseRunner::roundingOf(const ir::Program& program, bool byWords) const {
  constexpr double kSame = 1e-3, kFine = 1e6, kCounted = 4;            // of a step; steps in a mm
  const double steps = std::pow(10, inputs_->sourceControl->decimals); // in a mm
  const auto between = [](double value, double unit) {
    return std::abs(value * unit - std::round(value * unit)) > kSame;
  };
  bool coarse = false, rest = false, computed = false;
  const auto look = [&](const ir::ExpressionPtr& expression) {
    const double* value = expression ? ir::constantValue(expression) : nullptr;
    if (expression && value == nullptr) {
      coarse = true; // computed on the control
      ir::eachNode(expression, [&](const ir::Expression& node) {
        const auto* constant = std::get_if<ir::Constant>(&node.node);
        computed = computed || (constant != nullptr && between(constant->value, kFine));
      });
    }
    if (value == nullptr) return;
    coarse = coarse || between(*value, steps);
    rest = rest || between(*value, kFine);
  };
  for (const ir::ProgramStatement& statement : program.body) {
    if (const auto* call = std::get_if<ir::Call>(&statement.node))
      for (const ir::CallArgument& given : call->arguments)
        look(given.value);
    if (const auto* block = std::get_if<ir::NcBlock>(&statement.node))
      for (const ir::Word& word : block->words)
        if (word.address >= 'X' && word.address <= 'Z') look(word.value);
  }
  // Times a counter it is several steps.
  if (computed) return kCounted / steps;
  return rest || (coarse && byWords) ? 1 / steps : 0;
}

// The one set that knows all macros which the posted program calls.
void CaseRunner::findMacros(const ir::Program& program) {
  std::set<std::uint32_t> called;
  for (const ir::ProgramStatement& statement : program.body) {
    const auto* call = std::get_if<ir::Call>(&statement.node);
    const double* number = call != nullptr && call->program ? ir::constantValue(call->program) : nullptr;
    if (number != nullptr && *number >= 1 && *number < 1e8)
      called.insert(static_cast<std::uint32_t>(std::lround(*number)));
  }
  const stdlib::MacroSet* only = nullptr;
  for (const stdlib::MacroSet& set : session_.macroSets(&*inputs_->sourceControl)) {
    const bool all =
        std::all_of(called.begin(), called.end(), [&](std::uint32_t number) { return set.calls(number); });
    if (called.empty() || !all) continue;
    if (only != nullptr) return;
    only = &set;
  }
  if (only == nullptr) return;
  sourceSet_ = only;
  sourceStand_.emplace(*inputs_->sourceControl, std::vector<const stdlib::MacroSet*>{only},
                       session_.limits());
  sourceStand_->passOverAbsent();
}

bool CaseRunner::isGiven(const char* host) const {
  return plan_.fixedHosts.contains(host) ||
         std::any_of(options_.values.begin(), options_.values.end(),
                     [&](const auto& value) { return value.first == host; });
}

// What is given stays as it is.
void CaseRunner::startOnRetract(verify::Case& drawn) const {
  if (!plan_.startsOnRetract) return;
  if (!isGiven("start_z"))
    drawn.hosts["start_z"] = drawn.hosts["retract"];
  else if (!isGiven("retract"))
    drawn.hosts["retract"] = drawn.hosts["start_z"];
}

// A program that goes home would come down to it from a place above, which the machine does not reach. Home
// is where the axes are 0: the ball hangs below by the length of the probe.
std::string CaseRunner::whyAboveHome(const Values& values) const {
  const std::vector<sim::Point3>& points = values.path->points;
  const sim::Probe probe = probeFor(plan_, values.drawn);
  const double home = -probe.centreLength() - probe.ballRadius();
  const bool above =
      std::any_of(points.begin() + 1, points.end(), [&](const sim::Point3& point) { return point.z > home; });
  const ir::Program& program = values.posted->file.programs.front();
  return above && blockWith(program, *inputs_->sourceControl, stdlib::Function::ReferenceReturn)
             ? "the path lies above the reference position, to which the program returns"
             : "";
}

// The plane that a ToolPath.mac reads and that of ZCP1 are one, the main clearance plane, on which the CAM
// begins. A path that goes there shows it; one that states all heights by fields says nothing of it.
void CaseRunner::clearOnRetract(verify::Case& drawn, const verify::DrawnPath& path) const {
  const auto retract = drawn.hosts.find("retract");
  if (retract == drawn.hosts.end()) return;
  const bool goesThere =
      std::any_of(path.points.begin() + 1, path.points.end(),
                  [&](const sim::Point3& point) { return std::abs(point.z - retract->second) <= 1e-9; });
  if (!goesThere) return;
  for (const char* const host : {"clearance", "start_z"})
    if (drawn.hosts.contains(host) && !isGiven(host)) drawn.hosts[host] = retract->second;
}

} // namespace dotek::targets
