// Writing a work offset ourselves, where the macro's own rule is another one than the source's.
#include "backends/common/NamedSystems.h"
#include "backends/fanuc/OwnCycles.h"
#include "backends/fanuc/State.h"
#include "backends/fanuc/Uses.h"
#include "ir/Evaluate.h"
#include "ir/Liveness.h"
#include "ir/Walk.h"
#include "support/Decimal.h"
#include "support/messages/Fanuc.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace dotek::backends::fanuc {

namespace {

constexpr std::string_view kSourceSet = "take the macro set of the source";

constexpr double kFirstSystem = 54, kLastSystem = 59;
constexpr std::uint32_t kMaxSteps = 10000;

ir::ExpressionPtr plus(const ir::ExpressionPtr& a, const ir::ExpressionPtr& b) {
  return ir::binary(ir::BinaryOp::Add, a, b);
}
ir::ExpressionPtr minus(const ir::ExpressionPtr& a, const ir::ExpressionPtr& b) {
  return ir::binary(ir::BinaryOp::Subtract, a, b);
}

// Why an offset cannot be written; "" where it can.
std::string obstacle(const State& state) {
  const stdlib::SystemVariables& variables = state.control.variables;
  if (!variables.workOffsetX || !variables.externalX || variables.axisStep == 0 || variables.systemStep == 0)
    return "the control has no variables of the offsets";
  if (!workSystemVariable(state.control)) return "no variable says which work system is active";
  if (state.guards.rotation == Guard::Unchecked) return "a rotation may be active";
  if (state.guards.scaling == Guard::Unchecked) return "a scaling may be active";
  if (state.guards.shift == Guard::Unchecked) return "a local shift may be active";
  if (state.guards.extended == Guard::Unchecked) return "an extended work system may be active";
  if (!state.copied.inForce.empty() && !state.copied.inForce[state.at].empty())
    return "`" + state.copied.inForce[state.at] + "` of a copied block may be in force";
  return "";
}

ir::ResultName positionOf(ir::Axis axis) {
  constexpr ir::ResultName kNames[] = {ir::ResultName::PositionX, ir::ResultName::PositionY,
                                       ir::ResultName::PositionZ};
  return kNames[ir::indexOf(axis)];
}

// Whether the checks reject all that is no system. Tried, not proved: an alarm too many does no harm.
bool checksConfine(const State& state, ir::VariableId id) {
  bool tried = false;
  for (ir::Environment& environment : environmentsOf(state.cycle)) {
    // Where they reject a system, too, they say nothing of what is none.
    environment[id] = ir::Scalar::of(kFirstSystem);
    if (ir::runChecks(state.cycle, environment, kMaxSteps).end == ir::CheckRun::End::Alarm) continue;
    tried = true;
    for (const double value : {-99999.0, -1.0, 0.0, 1.0, 53.0, 53.5, 59.5, 60.0, 61.0, 100.0, 99999.0}) {
      environment[id] = ir::Scalar::of(value);
      if (ir::runChecks(state.cycle, environment, kMaxSteps).end != ir::CheckRun::End::Alarm) return false;
    }
  }
  return tried;
}

} // namespace

bool confinedTo(const State& state, const ir::ExpressionPtr& value, double least, double most) {
  return passOnly(state.cycle, value, {}, [&](double there) {
    return there >= least && there <= most && there == std::trunc(there);
  });
}

ir::ExpressionPtr offsetNumber(const stdlib::Control& control, const ir::ExpressionPtr& system,
                               ir::Axis axis) {
  const stdlib::SystemVariables& variables = control.variables;
  const int first = *variables.workOffsetX + static_cast<int>(ir::indexOf(axis)) * variables.axisStep;
  const ir::ExpressionPtr index = minus(system, ir::constant(kFirstSystem));
  if (variables.systemStep == 1) return tidy(plus(ir::constant(first), index));
  return tidy(plus(ir::constant(first),
                   ir::binary(ir::BinaryOp::Multiply, index, ir::constant(variables.systemStep))));
}

std::optional<int> workSystemVariable(const stdlib::Control& control) {
  const auto* code = control.find(stdlib::Function::WorkSystem);
  if (code == nullptr || !code->group || !control.variables.modalFirst) return std::nullopt;
  return *control.variables.modalFirst + *code->group;
}

void writeOffset(State& state, const ir::OffsetSetting& setting, ir::Axis axis,
                 const stdlib::MacroSignature& signature, const ir::Origin& given) {
  const std::string why = obstacle(state);
  if (!why.empty()) {
    state.refuse<diag::OffsetWriteUnsafe>(given.range(), std::string(1, ir::letterOf(axis)), why, kSourceSet);
    return;
  }
  const auto result = std::find_if(signature.results.begin(), signature.results.end(),
                                   [&](const auto& r) { return r.name == positionOf(axis); });
  if (result == signature.results.end()) {
    state.refuse<diag::OffsetWriteUnsafe>(given.range(), std::string(1, ir::letterOf(axis)),
                                          "the macro does not say where it leaves the measured position",
                                          kSourceSet);
    return;
  }
  ir::Origin origin = given;
  origin.reason = "offset: active one + measured - nominal";
  if (axis == ir::Axis::Z) state.shiftOfZ = true;
  state.writesOffset = true;
  writeWait(state, origin);
  const ir::ExpressionPtr active = systemVariable(*workSystemVariable(state.control));
  const ir::ExpressionPtr measured = systemVariable(static_cast<int>(result->variable));
  const ir::ExpressionPtr value =
      minus(plus(ir::machineVariable(offsetNumber(state.control, active, axis)), measured),
            setting.nominal[ir::indexOf(axis)]);
  assign(state, offsetText(state, setting, axis, signature, origin), value, origin);
}

void writeSetOffset(State& state, const ir::CallCycle& set, const ir::Origin& given) {
  const std::string why = obstacle(state);
  guardSystem(state, set.setting->system, given);
  ir::Origin origin = given;
  origin.reason = "offset: active one + measured - nominal";
  bool waits = false;
  for (const ir::Axis axis : ir::kAxes) {
    const std::string parameter = std::string("measured ") + "xyz"[ir::indexOf(axis)];
    const auto measured =
        std::find_if(set.arguments.begin(), set.arguments.end(),
                     [&](const ir::CycleArgument& one) { return one.parameter == parameter; });
    if (measured == set.arguments.end()) continue;
    if (!why.empty()) {
      state.refuse<diag::OffsetWriteUnsafe>(given.range(), std::string(1, ir::letterOf(axis)), why,
                                            "take another control (`dotek list controls`), or make the place "
                                            "a result and set the offset by hand");
      return;
    }
    if (axis == ir::Axis::Z) state.shiftOfZ = true;
    state.writesOffset = true;
    if (!std::exchange(waits, true)) writeWait(state, origin);
    const ir::ExpressionPtr active = systemVariable(*workSystemVariable(state.control));
    const ir::ExpressionPtr value =
        tidy(minus(plus(ir::machineVariable(offsetNumber(state.control, active, axis)), measured->value),
                   set.setting->nominal[ir::indexOf(axis)]));
    const std::string left =
        machineText(state, offsetNumber(state.control, set.setting->system, axis), origin);
    assign(state, left, value, origin);
    state.releaseHelpers();
  }
}

void writeWait(State& state, const ir::Origin& origin) {
  const auto* wait = state.control.find(stdlib::Function::MachineCoordinates);
  if (wait != nullptr && wait->grade != "assumed") state.sheet.add(codeText(*wait), origin);
}

namespace {

// A variable of the machine that the branch or a macro that it calls may set before it is read, or a result.
bool comesLater(const State& state, const ir::Expression& node) {
  if (std::holds_alternative<ir::MeasuredResult>(node.node)) return true;
  const auto* variable = std::get_if<ir::MachineVariable>(&node.node);
  if (variable == nullptr) return false;
  const double* number = ir::constantValue(variable->number);
  // #100 to #199: where macros leave their results.
  if (number == nullptr || (*number >= 100 && *number <= 199)) return true;
  bool stored = false;
  for (const ir::CycleStatement& statement : state.cycle.body)
    if (const auto* store = std::get_if<ir::Store>(&statement.node)) {
      const double* there = ir::constantValue(store->number);
      stored = stored || there == nullptr || *there == *number;
    }
  return stored;
}

} // namespace

bool knownAtEntry(const State& state, const ir::ExpressionPtr& value) {
  bool later = false;
  ir::eachNode(value, [&](const ir::Expression& node) { later = later || comesLater(state, node); });
  if (later) return false;
  const auto ids = variablesOf(value);
  return std::all_of(ids.begin(), ids.end(), [&](ir::VariableId id) {
    // What the checks compute is known when they are done, before anything moves; a branch has none.
    const bool known = state.cycle.variable(id).role != ir::Role::Local ||
                       (!state.options.branch && isAssigned(state.cycle.checks, id));
    return known && !isAssigned(state.cycle.body, id);
  });
}

void guardSystem(State& state, const ir::ExpressionPtr& given, const ir::Origin& origin,
                 const ExtendedSystems& extended) {
  const ir::ExpressionPtr system = tidy(given);
  if (const double* value = ir::constantValue(system)) {
    if (namesSystem(*value, extended)) return;
    const SystemWords words = systemWords(*value, state.options.source, state.control, "write one of those");
    state.refuse<diag::SystemRange>(system->range.hasPlace() ? system->range : origin.range(), words.number,
                                    words.remedy);
    return;
  }
  const auto same = std::find_if(state.systems.begin(), state.systems.end(),
                                 [&](const NamedSystem& other) { return ir::equal(other.number, system); });
  if (same != state.systems.end()) {
    if (extended.first == 0) same->extended = {}; // somewhere it is one of the six
    return;
  }
  if (knownAtEntry(state, system))
    state.systems.push_back({system, extended});
  else
    writeSystemAlarm(state, {system, extended}, origin);
}

namespace {

// Before the body its own locals hold nothing yet. 0: none is left.
std::uint32_t helperAtEntry(State& state) {
  const std::uint32_t taken = state.helper();
  if (taken != 0 || state.body != nullptr) return taken;
  ir::Cycle checks = state.cycle;
  checks.body.clear();
  const auto inChecks = usedVariables(checks), atEntry = ir::liveAtEntry(state.cycle.body, {});
  for (const auto& [id, local] : state.locals)
    if (state.cycle.variable(id).role == ir::Role::Local && !inChecks.contains(id) && !atEntry.contains(id) &&
        !state.isArgument(id))
      return local;
  return 0;
}

} // namespace

void dropDefaultsElsewhere(State& state) {
  for (const NamedSystem& system : state.systems) {
    const std::set<ir::VariableId> given = givenFor(state.cycle, system.number);
    if (given.size() != 1) continue;
    const ir::VariableId id = *given.begin();
    ir::Variable& variable = state.cycle.variables[id];
    if (variable.role != ir::Role::Parameter || !variable.defaultValue) continue;
    ir::Environment defaults(state.cycle.variables.size());
    for (ir::VariableId one = 0; one < defaults.size(); ++one)
      if (const auto& value = state.cycle.variable(one).defaultValue) defaults[one] = ir::Scalar::of(*value);
    const ir::Scalar named = ir::evaluate(*system.number, withLocals(state.cycle, defaults));
    if (!named.known() || namesSystem(named.value, system.extended)) continue;
    if (passesNoSystem(state.cycle, id, system.number, system.extended)) continue; // refused as a whole
    state.diagnostics.report<diag::DefaultSystemElsewhere>(
        variable.range, variable.name, numberText(*variable.defaultValue), numberText(named.value),
        state.control.title + " by macros of " + state.macros.title);
    variable.defaultValue.reset();
  }
}

void writeSystemAlarm(State& state, const NamedSystem& which, const ir::Origin& given) {
  const ir::ExpressionPtr& named = which.number;
  ir::Origin origin;
  origin.ranges = given.ranges;
  origin.reason = "range of the work system";
  const auto* use = std::get_if<ir::VariableUse>(&named->node);
  // What may be left out is not looked at where it is.
  const bool mayMiss = use != nullptr && state.cycle.variable(use->variable).optional &&
                       !state.cycle.variable(use->variable).defaultValue;
  ir::ExpressionPtr system = named;
  if (mayMiss) {
    const std::uint32_t helper = helperAtEntry(state);
    if (helper == 0) {
      state.refuse<diag::TooManyLocals>(state.cycle.range, "the work system", state.control.locals);
      return;
    }
    const std::string left = "#" + std::to_string(helper);
    system = systemVariable(static_cast<int>(helper));
    state.sheet.add(left + "=" + valueText(state, named, origin), origin);
    doIf(state, ir::isNull(system), left + "=" + valueText(state, ir::constant(kFirstSystem), origin),
         origin);
  }
  for (const ir::VariableId id : givenFor(state.cycle, named))
    if (const auto passes = passesNoSystem(state.cycle, id, which.number, which.extended)) {
      const std::string& name = state.cycle.variable(id).name;
      const SystemWords words =
          systemWords(passes->number, state.options.source, state.control,
                      "correct the checks, or what the post prints from `" + name + "`");
      state.refuse<diag::SystemNeverNamed>(origin.range(), name, numberText(passes->given), words.number,
                                           words.remedy);
      return;
    }
  const bool more = which.extended.first != 0;
  // S154.01 is no number that a control holds exactly.
  const double beside = which.extended.step < 1 ? which.extended.step / 2 : 0;
  const std::string_view text = more ? "NO SUCH WORK OFFSET" : "WORK OFFSET NOT 54 TO 59";
  if (use == nullptr || state.cycle.variable(use->variable).role == ir::Role::Local ||
      !checksConfine(state, use->variable)) {
    alarmIf(state, ir::compare(ir::Relation::Less, system, ir::constant(kFirstSystem)), text, origin);
    const ir::ConditionPtr above = ir::compare(ir::Relation::Greater, system, ir::constant(kLastSystem));
    alarmIf(
        state,
        more ? ir::join(ir::Connective::And, above,
                        ir::compare(ir::Relation::Less, system, ir::constant(which.extended.first - beside)))
             : above,
        text, origin);
    if (more)
      alarmIf(state, ir::compare(ir::Relation::Greater, system, ir::constant(which.extended.last + beside)),
              text, origin);
  }
  const ir::ConditionPtr broken =
      ir::compare(ir::Relation::NotEqual, system, ir::unary(ir::UnaryOp::Truncate, system));
  // S154.01: of the first six alone.
  alarmIf(state,
          which.extended.step < 1
              ? ir::join(ir::Connective::And,
                         ir::compare(ir::Relation::LessEqual, system, ir::constant(kLastSystem)), broken)
              : broken,
          text, origin);
  state.releaseHelpers();
}

} // namespace dotek::backends::fanuc
