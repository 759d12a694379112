#include "backends/fanuc/Emit.h"

#include "backends/common/JoinedSets.h"
#include "backends/common/MovedMacros.h"
#include "backends/fanuc/OwnCycles.h"
#include "backends/fanuc/State.h"
#include "backends/fanuc/Uses.h"
#include "ir/Flow.h"
#include "ir/Positions.h"
#include "ir/Walk.h"
#include "support/Decimal.h"
#include "support/messages/CamFolder.h"
#include "support/messages/Fanuc.h"

#include <algorithm>
#include <cmath>

namespace dotek::backends::fanuc {

namespace {

// Programs that parameters give to G, M and T codes.
constexpr std::uint32_t kFirstOfCodes = 9000, kLastOfCodes = 9029;

ir::Origin made(std::string reason) {
  ir::Origin out;
  out.reason = std::move(reason);
  return out;
}

bool switches(const State& state, bool on) {
  const auto& body = state.cycle.body;
  return std::any_of(body.begin(), body.end(), [&](const ir::CycleStatement& statement) {
    const auto* call = std::get_if<ir::CallCycle>(&statement.node);
    if (const CalledProgram* const program = call == nullptr ? nullptr : calledProgram(state, *call))
      return on ? program->switchesOn : program->switchesOff;
    return ir::switchesProbe(statement) == on;
  });
}

// Between the modes: the cycle's blocks.
void writeBody(State& state) {
  Body body = findBody(state);
  planResults(state, body);
  if (state.failed) return;
  state.body = &body;
  const bool macro = state.options.probePower == ProbePowerMode::Macro && ir::probes(state.cycle);
  if (macro && !switches(state, true)) writeProbePower(state, true, made("probe on"));
  writeList(state, state.cycle.body, true);
  if (macro && !switches(state, false)) writeProbePower(state, false, made("probe off"));
  if (switches(state, true) && !switches(state, false) && !macro)
    state.remarks.push_back("THE PROBE STAYS ON");
  state.body = nullptr;
}

// On each way through the body a G43 comes before anything moves the tool or measures: the caller's length
// does not count.
bool takesOwnLength(const State& state) {
  const auto takes = [&](const ir::OpaqueBlock& block) {
    return std::any_of(block.words.begin(), block.words.end(), [&](const ir::Word& word) {
      const double* code = word.address == 'G' && word.value ? ir::constantValue(word.value) : nullptr;
      if (code == nullptr || *code < 0 || *code > 9999) return false;
      const auto* info = state.control.find('G', static_cast<std::uint32_t>(std::lround(*code * 10)));
      return info != nullptr && info->function == stdlib::Function::ToolLengthPlus;
    });
  };
  enum class Then : std::uint8_t { GoOn, Takes, Ends };
  const auto& body = state.cycle.body;
  const auto next = ir::successors(body);
  std::vector<bool> seen(body.size() + 1, false);
  std::vector<std::size_t> open = {0};
  bool taken = false;
  while (!open.empty()) {
    const std::size_t at = open.back();
    open.pop_back();
    if (at >= body.size() || seen[at]) continue;
    seen[at] = true;
    const Then then = match(
        body[at], [&](const ir::OpaqueBlock& node) { return takes(node) ? Then::Takes : Then::GoOn; },
        [](const ir::Move& node) {
          const bool down = node.axes[ir::indexOf(ir::Axis::Z)].has_value();
          return down || node.motion == ir::Motion::Protected ? Then::Ends : Then::GoOn;
        },
        [](const ir::CallCycle& node) { return node.moves ? Then::Ends : Then::GoOn; },
        [](const ir::Measure&) { return Then::Ends; },
        [](const ir::OneOf<ir::Store, ir::ProbePower, ir::Comment, ir::Assign, ir::Spindle, ir::Coolant,
                           ir::SetMode, ir::Dwell, ir::Stop, ir::Alarm, ir::Label, ir::Jump, ir::Branch,
                           ir::Return, ir::Port, ir::Print> auto&) { return Then::GoOn; });
    if (then == Then::Ends) return false;
    taken = taken || then == Then::Takes;
    if (then == Then::GoOn) open.insert(open.end(), next[at].begin(), next[at].end());
  }
  return taken;
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

std::optional<std::vector<EmittedLine>> emit(const ir::Cycle& given, const EmitOptions& options,
                                             const SourceMap& sources, Diagnostics& diagnostics,
                                             std::vector<Argument>* assigned, std::uint32_t* alarms) {
  if (!fits(options, given.range, diagnostics) || !holdsKept(options.macros, options.control, diagnostics))
    return std::nullopt;
  const ir::Cycle cycle = joinSets(withTouchCalls(given, options.macros), options.macros);
  auto arguments = assignLetters(cycle, options, diagnostics);
  if (!arguments) return std::nullopt;
  if (assigned != nullptr) *assigned = *arguments;
  State state(cycle, options, sources, diagnostics, std::move(*arguments));
  if (state.macros.needsSkipPosition && !state.control.variables.skip && ir::probes(cycle))
    state.refuse<diag::NoSkipPosition>(cycle.range, "macros of " + state.macros.title, state.control.title);
  state.guards = findGuards(state.control);
  if (takesOwnLength(state)) state.guards.toolLength = Guard::Absent;
  state.moving =
      movingVariables(options.unshared != nullptr ? *options.unshared : state.cycle, state.control);
  translateVariables(state);
  collectAlarms(state);
  state.copied = findCopiedModes(state);
  const auto saved = planModes(state);
  if (state.failed) return std::nullopt;

  // The body first: it says which start points and systems are needed at entry.
  writeBody(state);
  const Sheet body = std::exchange(state.sheet, Sheet());
  if (state.failed) return std::nullopt;
  dropDefaultsElsewhere(state);
  planDemands(state);
  writeArguments(state);
  writeStarts(state);
  if (!options.calledFrom) writeRequirements(state);
  writeList(state, state.cycle.checks, false);
  for (const NamedSystem& system : std::exchange(state.systems, {}))
    writeSystemAlarm(state, system, made("range of the work system"));
  for (const ir::ExpressionPtr& distance : std::exchange(state.distances, {}))
    writeDistanceAlarm(state, distance, made("way of a touch"));
  for (const ir::ExpressionPtr& tool : std::exchange(state.tools, {}))
    writeToolAlarm(state, tool, made("range of the tool offset"));
  for (const ir::ExpressionPtr& offset : std::exchange(state.lengths, {}))
    writeLengthAlarm(state, offset, made("a tool length that the program puts in force"));
  writeModes(state, saved);
  state.sheet.append(body);
  restoreModes(state, saved);
  const auto* end = state.control.find(stdlib::Function::Return);
  if (end == nullptr) state.refuse<diag::NoCode>(cycle.range, state.control.title, "the end of a program");
  if (state.failed) return std::nullopt;
  state.sheet.add(codeText(*end), made("end of the program"));
  if (options.ends) state.sheet.add("%", made("end of the file"));

  Sheet whole = header(state);
  whole.append(state.sheet);
  auto lines = whole.finish(state.control.sequenceLast);
  if (!lines) state.refuse<diag::TooManyJumps>(cycle.range, state.control.title, state.control.sequenceLast);
  if (state.failed) return std::nullopt;
  if (alarms != nullptr) *alarms = static_cast<std::uint32_t>(state.alarms.size());
  return lines;
}

namespace {

// Host inputs that a block reads, and that nothing gives to it.
void reportHosts(State& state) {
  for (const auto& [id, local] : state.locals) {
    const ir::Variable& variable = state.cycle.variable(id);
    if (variable.role != ir::Role::Host || variable.name.starts_with("start_")) continue;
    state.refuse<diag::CamHostUnknown>(state.cycle.range, variable.name, "a value of the machine or the job",
                                       variable.name);
  }
}

} // namespace

std::optional<BranchBlocks> emitBranch(const ir::Cycle& given, const EmitOptions& options,
                                       const SourceMap& sources, Diagnostics& diagnostics) {
  const BranchOptions& branch = *options.branch;
  const ir::Cycle cycle = joinSets(withTouchCalls(given, options.macros), options.macros);
  State state(cycle, options, sources, diagnostics, {});
  if (state.macros.needsSkipPosition && !state.control.variables.skip && ir::probes(cycle))
    state.refuse<diag::NoSkipPosition>(cycle.range, "macros of " + state.macros.title, state.control.title);
  state.guards = findGuards(state.control);
  translateVariables(state);
  collectAlarms(state);
  state.copied = findCopiedModes(state);
  if (state.failed) return std::nullopt;
  writeBody(state);
  const Sheet body = std::exchange(state.sheet, Sheet());
  if (state.failed) return std::nullopt;
  writeStarts(state);
  if (state.writesOffset) writeRequirements(state);
  for (const NamedSystem& system : std::exchange(state.systems, {})) {
    const auto* use = std::get_if<ir::VariableUse>(&system.number->node);
    if (use == nullptr || !branch.holes.contains(use->variable)) // those of fields are the dialog's business
      writeSystemAlarm(state, system, made("range of the work system"));
  }
  for (const ir::ExpressionPtr& distance : std::exchange(state.distances, {}))
    writeDistanceAlarm(state, distance, made("way of a touch"));
  reportHosts(state);
  if (branch.modes) writeModes(state, {});
  state.sheet.append(body);
  if (state.sheet.endsInTarget()) state.sheet.add("", made("end of the branch"));
  if (const Sheet::Line* back = state.sheet.backward())
    state.refuse<diag::BranchGoesBack>(back->out.ranges.empty() ? cycle.range : back->out.ranges.front());
  const auto lines = state.sheet.finish(branch.firstNumber, 1, state.control.sequenceLast);
  if (!lines) state.refuse<diag::TooManyJumps>(cycle.range, state.control.title, state.control.sequenceLast);
  if (state.failed) return std::nullopt;
  BranchBlocks out;
  const std::vector<bool> numbered = state.sheet.numbered();
  for (std::size_t i = 0; i < lines->size(); ++i)
    out.lines.push_back({(*lines)[i], numbered[i], state.sheet.lines()[i].comment});
  const std::size_t left = state.pool.left();
  out.variables.assign(branch.variables.begin(), branch.variables.end() - static_cast<std::ptrdiff_t>(left));
  return out;
}

} // namespace dotek::backends::fanuc
