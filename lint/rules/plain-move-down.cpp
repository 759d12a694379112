#include "ir/Dataflow.h"
#include "lint/NcProgram.h"
#include "lint/Skips.h"

#include <algorithm>
#include <utility>

namespace dotek::lint::rule {
namespace {

// Height of the last move along Z, where it is written out in coordinates.
using Height = std::optional<double>;

Height heightOf(const ir::ProgramStatement& statement) {
  if (const auto* block = std::get_if<ir::NcBlock>(&statement.node)) return wordValue(*block, 'Z');
  if (const ir::Call* call = callOf(statement))
    for (const ir::CallArgument& argument : call->arguments)
      if (const double* z = argument.letter == 'Z' ? ir::constantValue(argument.value) : nullptr;
          z != nullptr)
        return *z;
  return std::nullopt;
}

void checkProgram(const NcProgram& nc, const Probing& probing, Report& report) {
  const ir::Program& program = nc.program;
  const auto& body = program.body;
  const bool guarded = std::any_of(body.begin(), body.end(), [&](const ir::ProgramStatement& s) {
    return probing.step(s).kind == ProbeStep::Kind::Protected;
  });
  if (!guarded) return;
  const auto& states = nc.probeStates();
  const auto& modes = nc.modes();
  const auto heights = ir::factsBefore<Height>(
      body, nc.flow(), Height{},
      [&](std::size_t at, std::size_t, Height height) {
        // A measurement returns to where it began.
        if (probing.step(body[at]).kind == ProbeStep::Kind::Measure) return height;
        if (const auto* block = std::get_if<ir::NcBlock>(&body[at].node);
            block != nullptr ? !hasWord(*block, 'Z') : callOf(body[at]) == nullptr)
          return height;
        // A protected move along X or Y stays on its height.
        const Height z = heightOf(body[at]);
        const ir::Call* call = callOf(body[at]);
        const bool level = call != nullptr && probing.step(body[at]).kind == ProbeStep::Kind::Protected &&
                           std::none_of(call->arguments.begin(), call->arguments.end(),
                                        [](const ir::CallArgument& one) { return one.letter == 'Z'; });
        return level ? height : z;
      },
      [](Height& into, const Height& other) {
        if (into == other || !into) return false;
        into.reset();
        return true;
      });
  // Whether a tool has been changed since the probe was switched on: it is in the magazine.
  const auto changed = ir::factsBefore<bool>(
      body, nc.flow(), false,
      [&](std::size_t at, std::size_t, bool since) {
        if (probing.step(body[at]).kind == ProbeStep::Kind::On) return false;
        const auto* block = std::get_if<ir::NcBlock>(&body[at].node);
        return since || (block != nullptr && hasCode(*block, 'M', 6));
      },
      [](bool& into, bool other) { return other && !std::exchange(into, true); });
  for (std::size_t i = 0; i < body.size(); ++i) {
    if (!states[i] || *states[i] != ProbeState::On || !isPlainMove(body[i]) || *changed[i]) continue;
    if (!modes[i] || *modes[i] == DistanceMode::Incremental) continue;
    const Height z = heightOf(body[i]);
    const Height before = *heights[i];
    if (!z || !before || *z >= *before) continue;
    report.at(
        body[i].origin.range(),
        "the probe is on, and this plain move takes it down from Z {} to Z {} without watching it; what is "
        "in the way breaks the stylus; use the protected move that the program uses elsewhere",
        *before, *z);
  }
}

void check(const NcProgram& nc, Report& report) {
  checkProgram(nc, probingOf(nc.project), report);
}

} // namespace

DOTEK_LINT_RULE(plain_move_down){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
