#include "lint/NcProgram.h"
#include "lint/Probing.h"

namespace dotek::lint::rule {
namespace {

// A measurement that every path reaches with the probe switched off before. `states` gives what is before
// each statement, and is asked where there is one.
template <ir::AnyStatement Statement, class States>
void checkBody(const std::vector<Statement>& body, const Probing& probing, const States& states,
               Report& report) {
  SourceRange off;
  for (std::size_t i = 0; i < body.size(); ++i) {
    const ProbeStep step = probing.step(body[i]);
    if (step.kind == ProbeStep::Kind::Off) off = body[i].origin.range();
    if (step.kind != ProbeStep::Kind::Measure || states()[i] != ProbeState::Off) continue;
    Diagnostic& finding = report.at(body[i].origin.range(),
                                    "the probe is off here: it was switched off before and not on again; the "
                                    "machine drives the stylus into the part; switch it on before");
    if (off.hasPlace()) finding.note(off, "switched off here");
    return; // the next ones have the same cause
  }
}

void check(const Project& project, Report& report) {
  for (const Joined& joined : project.joined)
    if (joined.lowered) {
      const Probing& probing = probingOf(project);
      const auto states = probing.states(joined.lowered->body);
      checkBody(
          joined.lowered->body, probing, [&]() -> const auto& { return states; }, report);
    }
}

void checkProgram(const NcProgram& nc, Report& report) {
  checkBody(
      nc.program.body, probingOf(nc.project), [&]() -> const auto& { return nc.probeStates(); }, report);
}

} // namespace

DOTEK_LINT_RULE(measure_with_probe_off){
    .severity = Severity::Error,
    .tier = Tier::Ir,
    .check = check,
    .program = checkProgram,
};

} // namespace dotek::lint::rule
