#include "tests/unit/MachineAdapter.h"

#include "frontend/macrob/Lower.h"
#include "sim/machine/Compile.h"
#include "sim/machine/Run.h"
#include "tests/unit/MacroBHelper.h"

#include <algorithm>
#include <cstdlib>
#include <string_view>

namespace dotek::tests {
namespace {

const stdlib::Control& controlOf(const std::string& name) {
  static const stdlib::Control modern = *stdlib::Control::load(stdlib::DataFiles(), "fanuc-31i-b");
  static const stdlib::Control older = *stdlib::Control::load(stdlib::DataFiles(), "fanuc-0i-md");
  return name == older.name ? older : modern;
}

// X Y Z of the moves in a trace.
std::vector<MacroPosition> movesOf(std::string_view trace) {
  std::vector<MacroPosition> out;
  while (!trace.empty()) {
    const std::size_t end = std::min(trace.find('\n'), trace.size());
    const std::string line(trace.substr(0, end));
    trace.remove_prefix(std::min(end + 1, trace.size()));
    if (!line.starts_with("rapid ") && !line.starts_with("feed ")) continue;
    MacroPosition position{};
    for (std::size_t axis = 0; axis < 3; ++axis)
      position[axis] = std::strtod(line.c_str() + line.find(" " + std::string(1, "XYZ"[axis])) + 2, nullptr);
    out.push_back(position);
  }
  return out;
}

SlowStop::Kind endingOf(const sim::RunEnd& end) {
  switch (end.ending) {
  case sim::Ending::ProgramEnd: return SlowStop::Kind::ProgramEnd;
  case sim::Ending::TextEnd: return SlowStop::Kind::TextEnd;
  case sim::Ending::Alarm: return SlowStop::Kind::Alarm;
  case sim::Ending::Limit: return SlowStop::Kind::Budget;
  case sim::Ending::Running:
  case sim::Ending::Return:
  case sim::Ending::Call:
  case sim::Ending::Inconclusive: break;
  }
  return SlowStop::Kind::Unsupported;
}

void runPrograms(const ir::ProgramFile& programs, const stdlib::Control& control, const SourceMap& sources,
                 const MacroSetup& setup, MachineRun& out) {
  std::vector<const ir::Program*> all;
  for (const ir::Program& program : programs.programs)
    all.push_back(&program);
  const sim::Bytecode code = sim::compile(all, control, sources);
  sim::Machine machine(control);
  std::uint32_t deleted = 0;
  for (const int number : setup.switches)
    deleted |= 1U << number;
  machine.setBlockDelete(deleted);
  std::string traced;
  sim::Trace trace([&](std::string_view piece) { traced += piece; });
  machine.setTrace(&trace);
  Limits limits;
  limits.simSteps = static_cast<std::uint32_t>(setup.budget * 20); // a block counts 10
  sim::Run run(machine, code, limits);
  run.run();
  trace.flush();
  machine.setTrace(nullptr);

  MacroOutcome& outcome = out.outcome;
  const sim::RunEnd& end = machine.end();
  outcome.ending = endingOf(end);
  if (outcome.ending == SlowStop::Kind::Alarm) outcome.alarm = static_cast<int>(end.number);
  if (outcome.ending == SlowStop::Kind::Unsupported) outcome.reason = end.text;
  outcome.line = static_cast<std::uint32_t>(end.line);
  for (const auto& [number, value] : machine.written()) {
    if (sim::isNull(value)) continue;
    (number <= control.locals ? outcome.locals : outcome.common)[static_cast<int>(number)] = value;
  }
  outcome.output = run.output();
  outcome.positions = movesOf(traced);
  outcome.blocks = machine.blocks();
}

} // namespace

MachineRun runOnMachine(const std::string& text, const MacroSetup& setup) {
  MachineRun out;
  MacroFile parsed(text);
  const stdlib::Control& control = controlOf(setup.control);
  const auto programs = frontend::macrob::lower(parsed.file, control, parsed.sources, parsed.diagnostics);
  if (programs)
    runPrograms(*programs, control, parsed.sources, setup, out);
  else
    out.refusal = "not lowered: " + parsed.told();
  return out;
}

} // namespace dotek::tests
