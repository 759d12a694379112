#include "lint/ProgBlocks.h"
#include "lint/Skips.h"

#include <cmath>

namespace dotek::lint::rule {
namespace {

// Radius of the smallest usual stylus, a ball of 1 mm.
constexpr double kSmallest = 0.5;

struct Travel {
  char letter = 0;
  double value = 0;
};

// A signed travel along X or Y of a call of a measuring macro that counts from the start.
std::optional<Travel> travelOf(const ir::Call& call, const Project& project) {
  const double* number = call.program ? ir::constantValue(call.program) : nullptr;
  if (number == nullptr || *number < 1 || *number > 9999) return std::nullopt;
  const auto program = static_cast<std::uint32_t>(std::lround(*number));
  for (const stdlib::MacroSet& set : project.macroSets) {
    for (const stdlib::MacroSignature* signature : set.of(program)) {
      if (signature->intent != stdlib::Intent::Surface) continue;
      for (const ir::CallArgument& argument : call.arguments) {
        const stdlib::MacroArgument* known = signature->find(argument.letter);
        const double* value = ir::constantValue(argument.value);
        if (known != nullptr && known->role == stdlib::ArgumentRole::Target &&
            known->frame == ir::Frame::Here && known->axis != ir::Axis::Z && value != nullptr)
          return Travel{argument.letter, *value};
      }
    }
  }
  return std::nullopt;
}

void check(const Project& project, Report& report) {
  const auto tell = [&](SourceRange range, char axis, double travel) {
    report.at(
        range,
        "the travel along {} is {} mm; the ball touches one radius before its centre arrives, so with any "
        "stylus above a radius of {} mm it is in the part already; begin farther away",
        axis, travel, std::abs(travel));
  };
  eachProgram(project, [&](const ir::Program& program, const macrob::File&) {
    for (const ir::ProgramStatement& statement : program.body)
      if (const ir::Call* call = callOf(statement))
        if (const auto travel = travelOf(*call, project); travel && std::abs(travel->value) <= kSmallest)
          tell(statement.origin.range(), travel->letter, travel->value);
  });
  for (const Joined& joined : project.joined) {
    if (!joined.lowered) continue;
    const ir::Cycle& cycle = *joined.lowered;
    for (const ir::CycleStatement& statement : cycle.body) {
      const auto* measure = std::get_if<ir::Measure>(&statement.node);
      if (measure == nullptr || measure->feature != ir::Feature::Surface || !measure->target ||
          measure->axis == ir::Axis::Z || measure->target->frame != ir::Frame::Here)
        continue;
      const char axis = measure->axis == ir::Axis::X ? 'X' : 'Y';
      if (const double* value = ir::constantValue(measure->target->value);
          value != nullptr && std::abs(*value) <= kSmallest)
        tell(statement.origin.range(), axis, *value);
    }
  }
}

} // namespace

DOTEK_LINT_RULE(approach_shorter_than_radius){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .check = check,
};

} // namespace dotek::lint::rule
