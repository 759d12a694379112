#include "backends/fanuc/Emit.h"

#include "backends/fanuc/State.h"
#include "backends/fanuc/Uses.h"
#include "ir/Positions.h"
#include "ir/Walk.h"
#include "support/Decimal.h"
#include "support/messages/Fanuc.h"

#include <algorithm>

namespace dotek::backends::fanuc {

namespace {

constexpr double kFirstSystem = 1000; // the first variable that is the control's own
// Programs that parameters give to G, M and T codes.
constexpr std::uint32_t kFirstOfCodes = 9000, kLastOfCodes = 9029;

ir::Origin made(std::string reason) {
  ir::Origin out;
  out.reason = std::move(reason);
  return out;
}

bool switches(const ir::Cycle& cycle, bool on) {
  return std::any_of(cycle.body.begin(), cycle.body.end(), [&](const ir::CycleStatement& statement) {
    const auto* power = std::get_if<ir::ProbePower>(&statement.node);
    return power != nullptr && power->on == on;
  });
}

// Between the modes: the cycle's blocks.
void writeBody(State& state) {
  Body body = findBody(state);
  planResults(state, body);
  if (state.failed) return;
  state.body = &body;
  const bool macro = state.options.probePower == ProbePowerMode::Macro && ir::probes(state.cycle);
  if (macro && !switches(state.cycle, true)) writeProbePower(state, true, made("probe on"));
  writeList(state, state.cycle.body, true);
  if (macro && !switches(state.cycle, false)) writeProbePower(state, false, made("probe off"));
  if (switches(state.cycle, true) && !switches(state.cycle, false) && !macro)
    state.remarks.push_back("THE PROBE STAYS ON");
  state.body = nullptr;
}

// Variables of the machine that the source reads: common ones, and others of its own control.
void checkMachineVariables(State& state) {
  for (const auto* list : {&state.cycle.checks, &state.cycle.body})
    for (const ir::CycleStatement& statement : *list)
      ir::eachNode(statement, [&](const ir::Expression& node) {
        const auto* machine = std::get_if<ir::MachineVariable>(&node.node);
        if (machine == nullptr) return;
        const double* number = ir::constantValue(tidy(machine->number));
        const bool same = state.control.name == state.options.sourceControl.name;
        const bool known = number != nullptr && *number >= 0 && *number < 1e9 &&
                           (state.control.isCommon(static_cast<std::uint32_t>(*number)) ||
                            (same && *number >= kFirstSystem));
        if (known) return;
        state.refuse<diag::MachineVariableRefused>(
            node.range.hasPlace() ? node.range : statement.origin.range(),
            number == nullptr ? "[..]" : numberText(*number), state.control.title);
      });
}

bool fits(const EmitOptions& options, SourceRange range, Diagnostics& diagnostics) {
  const std::uint32_t number = options.programNumber;
  if (number < 1 || number > options.control.programLast) {
    diagnostics.report<diag::ProgramNumber>(range, number, options.control.programLast,
                                            options.control.title);
    return false;
  }
  if (options.macros.calls(number)) {
    diagnostics.report<diag::ProgramNumberTaken>(range, number, options.macros.title);
    return false;
  }
  if (number >= kFirstOfCodes && number <= kLastOfCodes)
    diagnostics.report<diag::ProgramNumberOfCode>(range, number);
  return true;
}

} // namespace

std::optional<std::vector<EmittedLine>> emit(const ir::Cycle& cycle, const EmitOptions& options,
                                             const SourceMap& sources, Diagnostics& diagnostics,
                                             std::vector<Argument>* assigned) {
  if (!fits(options, cycle.range, diagnostics)) return std::nullopt;
  auto arguments = assignLetters(cycle, options, diagnostics);
  if (!arguments) return std::nullopt;
  if (assigned != nullptr) *assigned = *arguments;
  State state(cycle, options, sources, diagnostics, std::move(*arguments));
  if (state.macros.needsSkipPosition && !state.control.variables.skip && ir::probes(cycle))
    state.refuse<diag::NoSkipPosition>(cycle.range, "macros of " + state.macros.title, state.control.title);
  state.guards = findGuards(state.control);
  state.moving = movingVariables(state.cycle);
  checkMachineVariables(state);
  collectAlarms(state);
  state.copied = findCopiedModes(state);
  const auto saved = planModes(state);
  if (state.failed) return std::nullopt;

  // The body first: it says which start points and systems are needed at entry.
  writeBody(state);
  const Sheet body = std::exchange(state.sheet, Sheet());
  if (state.failed) return std::nullopt;
  writeArguments(state);
  writeStarts(state);
  writeRequirements(state);
  writeList(state, state.cycle.checks, false);
  for (const ir::ExpressionPtr& system : std::exchange(state.systems, {}))
    writeSystemAlarm(state, system, made("range of the work system"));
  writeModes(state, saved);
  state.sheet.append(body);
  restoreModes(state, saved);
  const auto* end = state.control.find(stdlib::Function::Return);
  if (end == nullptr) state.refuse<diag::NoCode>(cycle.range, state.control.title, "the end of a program");
  if (state.failed) return std::nullopt;
  state.sheet.add(codeText(*end), made("end of the program"));
  state.sheet.add("%", made("end of the file"));

  Sheet whole = header(state);
  whole.append(state.sheet);
  auto lines = whole.finish(state.control.sequenceLast);
  if (!lines) state.refuse<diag::TooManyJumps>(cycle.range, state.control.title, state.control.sequenceLast);
  if (state.failed) return std::nullopt;
  return lines;
}

} // namespace dotek::backends::fanuc
