#include "backends/fusion/Emit.h"

#include "backends/common/MovedMacros.h"
#include "backends/fusion/State.h"
#include "ir/Positions.h"
#include "support/messages/Fanuc.h"
#include "support/messages/Fusion.h"

#include <algorithm>

namespace dotek::backends::fusion {

namespace {

// Jumps may lead from G91 to G90: nothing says what our own G90 would have to be put back to.
// nullptr: it stays absolute.
const ir::CycleStatement* turnsIncremental(const ir::Cycle& cycle) {
  for (const ir::CycleStatement& statement : cycle.body)
    if (const auto* mode = std::get_if<ir::SetMode>(&statement.node);
        mode != nullptr && mode->mode == ir::Mode::Incremental)
      return &statement;
  return nullptr;
}

bool isStraight(const ir::Cycle& cycle) {
  return std::all_of(cycle.body.begin(), cycle.body.end(), [](const ir::CycleStatement& statement) {
    return match(
        statement, [](const ir::OneOf<ir::Label, ir::Jump, ir::Branch, ir::Assign> auto&) { return false; },
        [](const ir::OneOf<ir::Store, ir::Move, ir::Measure, ir::CallCycle, ir::ProbePower, ir::Comment,
                           ir::Return, ir::Spindle, ir::Coolant, ir::SetMode, ir::Dwell, ir::Stop, ir::Alarm,
                           ir::OpaqueBlock, ir::Port, ir::Print> auto&) { return true; });
  });
}

// What the branch keeps where macros of the target's set work, or keep their calibration.
void checkStores(State& state) {
  const auto& body = state.cycle.body;
  if (std::none_of(body.begin(), body.end(), [](const auto& one) { return ir::probes(one); })) return;
  for (const ir::CycleStatement& one : body) {
    const auto* store = std::get_if<ir::Store>(&one.node);
    const double* number = store == nullptr ? nullptr : ir::constantValue(store->number);
    if (number == nullptr) continue;
    const auto within = [&](const auto& range) { return range.first <= *number && *number <= range.second; };
    const auto& scratch = state.options.macros.scratch;
    if (std::none_of(scratch.begin(), scratch.end(), within)) continue;
    const auto variable = static_cast<std::uint32_t>(*number);
    if (state.options.macros.keepsCalibration(variable))
      state.refuse<diag::StoreCalibration>(
          one.origin.range(), variable, state.options.macros.title,
          storeRemedy(state.options.macros, state.options.control, numbersOf(state.cycle)));
    else
      state.diagnostics.report<diag::StoreScratch>(one.origin.range(), variable, state.options.macros.title);
  }
}

// Names of parameters before those of hosts and locals, whoever is used first.
void nameFields(State& state) {
  for (ir::VariableId id = 0; id < state.cycle.variables.size(); ++id) {
    const ir::Variable& variable = state.cycle.variable(id);
    if (variable.role == ir::Role::Parameter) state.named.emplace(id, state.names.take(variable.name));
  }
}

} // namespace

State::State(const ir::Cycle& given, const EmitOptions& emitOptions, Diagnostics& report)
    : cycle(given), options(emitOptions), diagnostics(report), prefix(prefixOf(given.name)) {}

std::optional<std::vector<EmittedLine>> emit(const ir::Cycle& cycle, const EmitOptions& options,
                                             Diagnostics& diagnostics) {
  State state(cycle, options, diagnostics);
  // Jumps that the Prog prints are printed as they are.
  if (options.printed.empty() && !options.call) {
    state.refuse<diag::FusionNeedsProg>(cycle.range);
    return std::nullopt;
  }
  const ir::CycleStatement* const incremental = turnsIncremental(cycle);
  if (options.foreignMacros && incremental != nullptr && !isStraight(cycle) && callsMacros(cycle)) {
    state.refuse<diag::FusionOpaque>(incremental->origin.range(), options.macros.title);
    return std::nullopt;
  }
  if (options.macros.needsSkipPosition && !options.control.variables.skip && ir::probes(cycle)) {
    state.refuse<diag::NoSkipPosition>(cycle.range, "macros of " + options.macros.title,
                                       options.control.title);
    return std::nullopt;
  }
  if (!holdsKept(options.macros, options.control, diagnostics)) return std::nullopt;
  nameFields(state);
  checkStores(state);

  // The body first: it says what is read and which helpers are needed.
  Script rest;
  const auto body = [&](Script& into) {
    std::swap(state.script, into);
    if (options.call) {
      writeCall(state);
    } else {
      writeChecks(state);
      writeBlocks(state);
    }
    std::swap(state.script, into);
  };
  rest.indent();
  body(rest);
  if (state.failed) return std::nullopt;
  Script reading;
  reading.indent();
  std::swap(state.script, reading);
  writeReading(state);
  std::swap(state.script, reading);

  writeHead(state);
  writeProperties(state);
  Script& script = state.script;
  writeHelpers(state);
  if (options.call) writeProgram(state);
  script.add("// Checks the fields, then prints the blocks of the cycle.");
  script.add("function " + state.prefix + "_write(x, y, z) {");
  script.append(reading);
  script.append(rest);
  script.add("}");
  script.blank();
  script.add("// true: the operation is this cycle, and its blocks are printed.");
  script.open("function " + state.prefix + "_dispatch(x, y, z) {");
  script.add("switch (currentSection.getProperty(\"dotekCycle\")) {");
  script.open("case " + quoted(state.prefix) + ":");
  script.open("if (String(currentSection.strategy).indexOf(\"probe\") === 0) {");
  script.add("error(localize(" +
             quoted(cycle.name +
                    ": take a drilling operation with the probe as its tool; around a probing operation "
                    "the post prints calls of its own") +
             "));");
  script.add("return true;");
  script.close();
  if (!options.call) {
    // The macros travel from where the probe is, and no block of the cycle goes to a further point.
    script.open("if (!isFirstCyclePoint()) {");
    script.add("error(localize(" +
               quoted(cycle.name + ": nothing moves to a further point of the operation; give each point an "
                                   "operation of its own") +
               "));");
    script.add("return true;");
    script.close();
  }
  script.add(state.prefix + "_write(x, y, z);");
  script.add("return true;");
  script.close("default:");
  script.reopen();
  script.add("return false;");
  script.close("}");
  script.close();
  if (state.failed) return std::nullopt;
  return script.lines();
}

} // namespace dotek::backends::fusion
