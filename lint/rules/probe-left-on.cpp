#include "lint/NcProgram.h"
#include "lint/Probing.h"
#include "lint/ProgBlocks.h"

#include <algorithm>

namespace dotek::lint::rule {
namespace {

bool leaves(const ir::ProgramStatement& statement) {
  return std::holds_alternative<ir::Exit>(statement.node) || endsProgram(statement);
}

// A path on which the probe is on at the end.
void checkWays(const NcProgram& nc, const Probing& probing, Report& report) {
  const auto& body = nc.program.body;
  const ir::ProgramStatement* on = nullptr;
  bool off = false;
  for (const ir::ProgramStatement& statement : body) {
    const ProbeStep::Kind kind = probing.step(statement).kind;
    if (kind == ProbeStep::Kind::On) on = &statement;
    if (kind == ProbeStep::Kind::Off) off = true;
  }
  // Without any switch-off the probe may be meant for the next program; a caller switches it.
  if (on == nullptr || !off) return;
  const auto& states = nc.probeStates();
  for (std::size_t i = 0; i < body.size(); ++i) {
    if (!leaves(body[i]) || states[i] != ProbeState::On) continue;
    report
        .at(body[i].origin.range(),
            "the probe is still on here; its battery runs down, and the next tool may turn with "
            "the interlock of the probe in force; switch it off on this way, too")
        .note(on->origin.range(), "switched on here");
  }
}

void check(const NcProgram& nc, Report& report) {
  const ir::Program& program = nc.program;
  const Probing& probing = probingOf(nc.project);
  checkWays(nc, probing, report);
  if (!endsProgram(program)) return;
  // A main program that switches it on and never off.
  const ir::ProgramStatement* on = nullptr;
  bool other = false;
  for (const ir::ProgramStatement& statement : program.body) {
    const ProbeStep::Kind kind = probing.step(statement).kind;
    if (kind == ProbeStep::Kind::On) on = &statement;
    if (kind == ProbeStep::Kind::Off || kind == ProbeStep::Kind::Call || kind == ProbeStep::Kind::PackCall)
      other = true;
  }
  if (on != nullptr && !other)
    report.at(on->origin.range(),
              "the program switches the probe on and never off; its battery runs down, and the "
              "next tool may turn with the interlock of the probe in force; switch it off at "
              "the end");
}

} // namespace

DOTEK_LINT_RULE(probe_left_on){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
