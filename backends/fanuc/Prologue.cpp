// What precedes the cycle: arguments, start point, requirements of the caller.
#include "backends/common/PlainText.h"
#include "backends/fanuc/State.h"
#include "backends/fanuc/Uses.h"
#include "support/Decimal.h"

#include <algorithm>
#include <utility>

namespace dotek::backends::fanuc {

namespace {

using stdlib::Function;

// A difference of coordinates that is no shift.
constexpr double kSamePlace = 0.01; // mm

ir::ExpressionPtr minus(const ir::ExpressionPtr& a, const ir::ExpressionPtr& b) {
  return ir::binary(ir::BinaryOp::Subtract, a, b);
}

ir::Origin made(std::string reason) {
  ir::Origin out;
  out.reason = std::move(reason);
  return out;
}

std::optional<int> groupVariable(const stdlib::Control& control, Function function) {
  const auto* code = control.find(function);
  if (code == nullptr || !code->group || !control.variables.modalFirst) return std::nullopt;
  return *control.variables.modalFirst + *code->group;
}

ir::ExpressionPtr codeNumber(const stdlib::CodeInfo& code) {
  return ir::constant(code.tenths / 10.0);
}

// What `on` switches on and `off` off.
Guard guardOf(const stdlib::Control& control, Function on, Function off) {
  const auto* code = control.find(on);
  if (code == nullptr) return Guard::Absent;
  // What may exist is asked for, but not counted on.
  if (code->grade == "assumed") return Guard::Unchecked;
  return groupVariable(control, off) ? Guard::Checked : Guard::Unchecked;
}

Guard shiftGuard(const stdlib::Control& control, const Guards& guards) {
  const stdlib::SystemVariables& v = control.variables;
  if (control.find(Function::LocalShift) == nullptr) return Guard::Absent;
  const bool known = v.machine && v.position && v.externalX && v.workOffsetX && v.systemStep != 0 &&
                     v.axisStep != 0 && workSystemVariable(control);
  return known && guards.rotation != Guard::Unchecked && guards.scaling != Guard::Unchecked
             ? Guard::Checked
             : Guard::Unchecked;
}

void require(State& state, Function function, ir::Relation wrong, std::string_view text) {
  const auto variable = groupVariable(state.control, function);
  const auto* code = state.control.find(function);
  if (!variable || code == nullptr) return;
  alarmIf(state, ir::compare(wrong, systemVariable(*variable), codeNumber(*code)), text,
          made("requirement of the caller"));
}

// Not in force, as its group says; what is only assumed to exist may leave its group at 0.
void requireOff(State& state, Guard guard, Function on, Function off, std::string_view text) {
  const auto* code = state.control.find(on);
  if (code == nullptr) return;
  if (code->grade == "assumed")
    require(state, on, ir::Relation::Equal, text);
  else if (guard == Guard::Checked)
    require(state, off, ir::Relation::NotEqual, text);
}

void requireSystem(State& state) {
  const ir::ExpressionPtr active = systemVariable(*workSystemVariable(state.control));
  const ir::Origin origin = made("requirement of the caller");
  constexpr std::string_view kText = "G54 TO G59 NOT ACTIVE";
  alarmIf(state, ir::compare(ir::Relation::Less, active, ir::constant(54)), kText, origin);
  alarmIf(state, ir::compare(ir::Relation::Greater, active, ir::constant(59)), kText, origin);
  alarmIf(state, ir::compare(ir::Relation::NotEqual, active, ir::unary(ir::UnaryOp::Truncate, active)), kText,
          origin);
}

// Machine position - position - external offset - offset of the active system. Along Z this counts on a
// position that holds the tool length as the machine position does, so it is asked for only where an offset
// of Z is written: a control that tells it otherwise stops there.
void requireNoShift(State& state) {
  const stdlib::SystemVariables& v = state.control.variables;
  const ir::Origin origin = made("requirement of the caller");
  writeWait(state, made("waits until the axes are"));
  const ir::ExpressionPtr active = systemVariable(*workSystemVariable(state.control));
  for (const ir::Axis axis : ir::kAxes) {
    if (axis == ir::Axis::Z && !state.shiftOfZ) continue;
    const int i = static_cast<int>(ir::indexOf(axis));
    const ir::ExpressionPtr offset = ir::machineVariable(offsetNumber(state.control, active, axis));
    const ir::ExpressionPtr shift =
        minus(minus(minus(systemVariable(*v.machine + i), systemVariable(*v.position + i)),
                    systemVariable(*v.externalX + i * v.axisStep)),
              offset);
    alarmIf(
        state,
        ir::compare(ir::Relation::Greater, ir::unary(ir::UnaryOp::Absolute, shift), ir::constant(kSamePlace)),
        "LOCAL SHIFT ACTIVE", origin);
    state.releaseHelpers();
  }
}

} // namespace

Guards findGuards(const stdlib::Control& control) {
  Guards out;
  const auto known = [&](Function function) {
    return groupVariable(control, function) ? Guard::Checked : Guard::Unchecked;
  };
  out.metric = known(Function::Metric);
  out.cutterComp = known(Function::CutterCompOff);
  out.cannedCycle = known(Function::CannedCycleOff);
  out.toolLength = known(Function::ToolLengthOff);
  out.rotation = guardOf(control, Function::RotationOn, Function::RotationOff);
  out.scaling = guardOf(control, Function::ScalingOn, Function::ScalingOff);
  const auto* extended = control.find(Function::ExtendedWorkSystem);
  out.extended = extended == nullptr           ? Guard::Absent
                 : workSystemVariable(control) ? Guard::Checked
                                               : Guard::Unchecked;
  out.shift = shiftGuard(control, out);
  return out;
}

bool mayBeOmitted(const State& state, ir::VariableId id) {
  const ir::Variable& variable = state.cycle.variable(id);
  if (variable.optional) return true;
  if (variable.role != ir::Role::Parameter || !variable.defaultValue) return false;
  return state.options.defaults == Defaults::Use || !state.moving.contains(id);
}

void writeArguments(State& state) {
  for (const Argument& argument : state.arguments) {
    const ir::Variable& variable = state.cycle.variable(argument.variable);
    if (variable.optional || state.late.contains(argument.variable)) continue;
    ir::Origin origin = made("argument omitted");
    if (variable.range.hasPlace()) origin.ranges.push_back(variable.range);
    const ir::ConditionPtr omitted = ir::isNull(ir::variable(argument.variable));
    if (mayBeOmitted(state, argument.variable)) {
      const std::string value = valueText(state, ir::constant(*variable.defaultValue), origin);
      doIf(state, omitted, state.local(argument.variable) + "=" + value, origin);
    } else if (!state.options.calledFrom) {
      alarmIf(state, omitted, std::string("ARGUMENT ") + argument.letter + " MISSING", origin);
    }
  }
}

void writeStarts(State& state) {
  const auto first = state.control.variables.blockEnd;
  const auto used = usedVariables(state.cycle);
  bool waits = false; // the caller's own moves may still be under way
  const auto wait = [&] {
    if (!std::exchange(waits, true)) writeWait(state, made("waits until the axes are"));
  };
  for (const ir::Axis axis : ir::kAxes) {
    const int i = static_cast<int>(ir::indexOf(axis));
    const std::string name = std::string("start_") + static_cast<char>('x' + i);
    if (!first) continue;
    if (const auto id = state.findHost(name);
        id && !state.isArgument(*id) && (used.contains(*id) || state.locals.contains(*id))) {
      wait();
      state.sheet.add(state.local(*id) + "=#" + std::to_string(*first + i), made("start of the cycle"));
    }
    const auto fixed = state.options.fixed.find(name);
    if (fixed == state.options.fixed.end()) continue;
    wait();
    const ir::ExpressionPtr away =
        ir::unary(ir::UnaryOp::Absolute, minus(systemVariable(*first + i), ir::constant(fixed->second)));
    alarmIf(state, ir::compare(ir::Relation::Greater, away, ir::constant(kSamePlace)),
            std::string("START NOT AT ") + ir::letterOf(axis) + numberText(fixed->second),
            made("start was fixed"));
  }
}

void writeRequirements(State& state) {
  const Guards& guards = state.guards;
  if (guards.metric == Guard::Checked) require(state, Function::Metric, ir::Relation::NotEqual, "NOT METRIC");
  requireOff(state, guards.rotation, Function::RotationOn, Function::RotationOff, "ROTATION ACTIVE");
  requireOff(state, guards.scaling, Function::ScalingOn, Function::ScalingOff, "SCALING ACTIVE");
  if (guards.cutterComp == Guard::Checked)
    require(state, Function::CutterCompOff, ir::Relation::NotEqual, "CUTTER COMPENSATION ON");
  if (guards.cannedCycle == Guard::Checked)
    require(state, Function::CannedCycleOff, ir::Relation::NotEqual, "CANNED CYCLE ACTIVE");
  if (guards.toolLength == Guard::Checked)
    require(state, Function::ToolLengthOff, ir::Relation::Equal, "TOOL LENGTH NOT ACTIVE");
  if (guards.extended == Guard::Checked || guards.shift == Guard::Checked) requireSystem(state);
  if (guards.shift == Guard::Checked) requireNoShift(state);
}

} // namespace dotek::backends::fanuc
