#include "sim/run/CycleReport.h"

#include "sim/run/SimReport.h"
#include "support/Decimal.h"
#include "support/Printable.h"
#include "support/messages/Sim.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace dotek::sim {

namespace {

std::string_view endingOf(const Machine& machine) {
  switch (machine.end().ending) {
  case Ending::Alarm: return "alarm";
  case Ending::Limit: return "limit";
  case Ending::Inconclusive:
  case Ending::Call:
  case Ending::Return: return "inconclusive";
  case Ending::Running:
  case Ending::ProgramEnd:
  case Ending::TextEnd: break;
  }
  return "program-end";
}

std::uint32_t lineOf(const CycleRun& run, Session& session) {
  const SourceRange place = run.place();
  if (!place.hasPlace()) return 0;
  return session.sources().file(place.file).place(place.begin).line;
}

} // namespace

void reportCycle(const CycleRun& run, const Machine& machine, Session& session) {
  Diagnostics& diagnostics = session.diagnostics();
  const RunEnd& end = machine.end();
  switch (end.ending) {
  case Ending::Alarm:
    diagnostics.report<diag::CycleAlarm>(run.place(), end.text.empty() ? "without a text" : end.text);
    return;
  case Ending::Limit: diagnostics.report<diag::RunLimit>(run.place(), end.text); return;
  case Ending::Inconclusive:
  case Ending::Call:
  case Ending::Return: {
    std::string text = session.sources().textUtf8(run.place());
    diagnostics.report<diag::RunInconclusive>(run.place(), text.substr(0, text.find('\n')), end.text);
    return;
  }
  case Ending::Running:
  case Ending::ProgramEnd:
  case Ending::TextEnd: return;
  }
}

Measurement resultsOf(const ir::Cycle& cycle, const CycleRun& run) {
  Measurement out{0, "results of " + cycle.name, {}};
  const auto kindOf = [&](const std::string& name) {
    const auto found = std::find_if(cycle.variables.begin(), cycle.variables.end(),
                                    [&](const ir::Variable& one) { return one.name == name; });
    return found == cycle.variables.end() ? ir::Kind::Number : found->kind;
  };
  for (const auto& [name, value] : run.left())
    out.values.push_back({name, std::nullopt, value, kindOf(name)});
  return out;
}

void traceResults(const CycleRun& run, Trace& trace) {
  for (const auto& [name, value] : run.left())
    trace.begin("result").text(name).word("", value).end();
}

std::string cycleSummary(const ir::Cycle& cycle, const CycleRun& run, const Machine& machine,
                         const SimWorld& world, Session& session) {
  const RunEnd& end = machine.end();
  std::string parameters, results;
  const auto add = [](std::string& list, const std::string& name, const ir::Scalar& value) {
    list += fmt::format("{}{}: {}", list.empty() ? "" : ", ", jsonString(name),
                        value.known() ? jsonNumber(value.value, 6) : "null");
  };
  for (ir::VariableId id = 0; id < cycle.variables.size(); ++id)
    if (cycle.variable(id).role == ir::Role::Parameter)
      add(parameters, cycle.variable(id).name, run.value(id));
  for (const auto& [name, value] : run.left())
    add(results, name, ir::Scalar::of(value));
  std::string out = "{\n";
  out += fmt::format("  \"ending\": \"{}\",\n  \"control\": null,\n  \"cycle\": {},\n", endingOf(machine),
                     jsonString(cycle.name));
  out += fmt::format("  \"blocks\": {},\n", machine.blocks());
  out += fmt::format("  \"position\": {},\n", positionText(machine.knownPosition(), machine.movedAxes()));
  out +=
      fmt::format("  \"machine\": {},\n", positionText(machine.knownMachinePosition(), machine.movedAxes()));
  if (end.ending == Ending::Alarm)
    out += fmt::format("  \"alarm\": {{\"number\": null, \"text\": {}, \"line\": {}, \"stack\": []}},\n",
                       jsonString(end.text), lineOf(run, session));
  else
    out += "  \"alarm\": null,\n";
  out += fmt::format("  \"parameters\": {{{}}},\n  \"results\": {{{}}},\n", parameters, results);
  return out + world.summary() + diagnosticsMember(session.diagnostics(), session.sources()) + "}\n";
}

} // namespace dotek::sim
