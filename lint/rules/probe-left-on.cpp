#include "lint/NcProgram.h"
#include "lint/Probing.h"
#include "lint/ProgBlocks.h"

#include <algorithm>

namespace dotek::lint::rule {
namespace {

bool leaves(const ir::ProgramStatement& statement) {
  return std::holds_alternative<ir::Exit>(statement.node) || endsProgram(statement);
}

// A path on which the probe is on at the end. Whether there is one.
bool checkWays(const NcProgram& nc, const Probing& probing, Report& report) {
  const auto& body = nc.program.body;
  const ir::ProgramStatement* on = nullptr;
  bool off = false;
  for (const ir::ProgramStatement& statement : body) {
    const ProbeStep::Kind kind = probing.step(statement).kind;
    if (kind == ProbeStep::Kind::On) on = &statement;
    if (kind == ProbeStep::Kind::Off) off = true;
  }
  // Without any switch-off the probe may be meant for the next program; a caller switches it.
  if (on == nullptr || !off) return false;
  bool found = false;
  const auto& states = nc.probeStates();
  for (std::size_t i = 0; i < body.size(); ++i) {
    if (!leaves(body[i]) || states[i] != ProbeState::On) continue;
    report
        .at(body[i].origin.range(),
            "the probe is still on here; its battery runs down, and the next tool may turn with "
            "the interlock of the probe in force; switch it off on this path, too")
        .note(on->origin.range(), "switched on here");
    found = true;
  }
  return found;
}

// A jump from where the probe is on over all that switches it off. Where it is on only on some paths to
// the jump, the condition may be the one that switched it on.
template <ir::AnyStatement Statement>
void checkJumps(const std::vector<Statement>& body, const ir::ProgramFlow& flow,
                const std::vector<std::optional<ProbeState>>& states, const Probing& probing,
                Report& report) {
  const Statement* on = nullptr;
  std::vector<bool> off(body.size() + 1), end(body.size() + 1);
  end.back() = true;
  for (std::size_t i = 0; i < body.size(); ++i) {
    const ProbeStep::Kind kind = probing.step(body[i]).kind;
    if (kind == ProbeStep::Kind::On && on == nullptr) on = &body[i];
    off[i] = kind == ProbeStep::Kind::Off || kind == ProbeStep::Kind::Call;
  }
  if (on == nullptr || !flow.labels.empty() || std::find(off.begin(), off.end(), true) == off.end()) return;
  const std::vector<bool> later = ir::leadingTo(off, flow);
  const std::vector<bool> ends = ir::leadingTo(end, flow); // an alarm stops the run
  for (std::size_t i = 0; i < body.size(); ++i) {
    if (states[i] != ProbeState::On || !later[i] || flow.next[i].size() != 2) continue;
    for (const std::size_t next : flow.next[i])
      if (!later[next] && ends[next])
        report
            .at(body[i].origin.range(),
                "the probe is still on when this jumps over all that switches it off; its battery runs down, "
                "and the next tool may turn with the interlock of the probe in force; switch it off on this "
                "path, too")
            .note(on->origin.range(), "switched on here");
  }
}

void checkCycles(const Project& project, Report& report) {
  const Probing& probing = probingOf(project);
  for (const Joined& joined : project.joined) {
    if (!joined.lowered) continue;
    const auto& body = joined.lowered->body;
    checkJumps(body, ir::flowOf(body), probing.states(body), probing, report);
  }
}

void check(const NcProgram& nc, Report& report) {
  const ir::Program& program = nc.program;
  const Probing& probing = probingOf(nc.project);
  if (!checkWays(nc, probing, report)) checkJumps(program.body, nc.flow(), nc.probeStates(), probing, report);
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
    .check = checkCycles,
    .program = check,
};

} // namespace dotek::lint::rule
