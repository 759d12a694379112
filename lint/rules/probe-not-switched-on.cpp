#include "lint/NcProgram.h"
#include "lint/Probing.h"
#include "lint/ProgBlocks.h"

#include <algorithm>
#include <map>

namespace dotek::lint::rule {
namespace {

struct Unswitched {
  const Joined* joined = nullptr;
  SourceRange measure;
};

// The first measurement that is reached without a switch in this body.
template <ir::AnyStatement Statement>
SourceRange firstUnswitched(const std::vector<Statement>& body, const Probing& probing) {
  const auto states = probing.states(body);
  for (std::size_t i = 0; i < body.size(); ++i)
    if (probing.step(body[i]).kind == ProbeStep::Kind::Measure && states[i] == ProbeState::AsBefore)
      return body[i].origin.range();
  return {};
}

template <ir::AnyStatement Statement>
SourceRange firstSwitch(const std::vector<Statement>& body, const Probing& probing) {
  for (const Statement& statement : body)
    if (probing.step(statement).kind == ProbeStep::Kind::On) return statement.origin.range();
  return {};
}

// Cycles of one post: some switch the probe on in their own blocks, so that nobody else does it for them.
void checkCycles(const Project& project, const Probing& probing, Report& report) {
  std::map<const compost::Program*, SourceRange> switches;
  std::vector<Unswitched> found;
  for (const Joined& joined : project.joined) {
    if (!joined.lowered) continue;
    const SourceRange on = firstSwitch(joined.lowered->body, probing);
    const SourceRange measure = firstUnswitched(joined.lowered->body, probing);
    if (on.hasPlace()) switches.try_emplace(joined.prog, on);
    if (measure.hasPlace()) found.push_back({&joined, measure});
  }
  for (const Unswitched& one : found) {
    const auto on = switches.find(one.joined->prog);
    if (on == switches.end()) continue;
    report
        .at(one.measure,
            "no block of `{}` switches the probe on before this measurement, as other cycles of the post "
            "do; with the probe off the machine drives the stylus into the part; switch it on",
            one.joined->cycle->name)
        .note(on->second, "switched on here for another cycle");
  }
}

// A program that switches the probe off, or on later, is the one that switches it.
void checkProgram(const NcProgram& nc, const Probing& probing, Report& report) {
  const ir::Program& program = nc.program;
  SourceRange first;
  SourceRange last;
  bool callsBefore = false;
  for (std::size_t i = 0; i < program.body.size(); ++i) {
    const ProbeStep step = probing.step(program.body[i]);
    if (!first.hasPlace() && step.kind == ProbeStep::Kind::Call) callsBefore = true;
    if (step.kind == ProbeStep::Kind::Measure && !first.hasPlace() &&
        nc.probeStates()[i] == ProbeState::AsBefore)
      first = program.body[i].origin.range();
    if (step.kind == ProbeStep::Kind::On || step.kind == ProbeStep::Kind::Off)
      if (first.hasPlace() && !last.hasPlace()) last = program.body[i].origin.range();
  }
  // What a called program or a code of the builder switches is not seen here.
  if (!first.hasPlace() || !last.hasPlace() || callsBefore) return;
  report
      .at(first,
          "nothing before this measurement switches the probe on, though the program switches it later; with "
          "the probe off the machine drives the stylus into the part; switch it on first")
      .note(last, "switched here");
}

void check(const Project& project, Report& report) {
  checkCycles(project, probingOf(project), report);
}

void checkOne(const NcProgram& nc, Report& report) {
  checkProgram(nc, probingOf(nc.project), report);
}

} // namespace

DOTEK_LINT_RULE(probe_not_switched_on){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .check = check,
    .program = checkOne,
};

} // namespace dotek::lint::rule
