// Work systems of calls of another macro set, those beyond G59 included.
#include "backends/common/NamedSystems.h"
#include "backends/fusion/State.h"
#include "ir/Fold.h"
#include "support/Decimal.h"
#include "support/messages/Fanuc.h"

#include <cmath>

namespace dotek::backends::fusion {

namespace {

constexpr double kFirstSystem = 54, kLastSystem = 59;

ir::ExpressionPtr plus(const ir::ExpressionPtr& a, const ir::ExpressionPtr& b) {
  return ir::simplify(ir::binary(ir::BinaryOp::Add, a, b));
}
ir::ExpressionPtr minus(const ir::ExpressionPtr& a, const ir::ExpressionPtr& b) {
  return ir::simplify(ir::binary(ir::BinaryOp::Subtract, a, b));
}
ir::ExpressionPtr times(const ir::ExpressionPtr& a, const ir::ExpressionPtr& b) {
  return ir::simplify(ir::binary(ir::BinaryOp::Multiply, a, b));
}

// `six` of G54 to G59 and `beyond` of the others, whose numbers in a call are 100 and more.
ir::ExpressionPtr either(const State& state, const ir::ExpressionPtr& system, const ExtendedSystems& extended,
                         const ir::ExpressionPtr& six, const ir::ExpressionPtr& beyond) {
  if (isBeyond(state.cycle, system, extended)) return beyond;
  const bool one = passOnly(state.cycle, system, {}, [](double value) { return value <= kLastSystem; });
  if (one || ir::constantValue(ir::simplify(system)) != nullptr) return six;
  const ir::ExpressionPtr chosen = ir::unary(
      ir::UnaryOp::Truncate,
      ir::binary(ir::BinaryOp::Divide, minus(system, ir::constant(kFirstSystem - 1)), ir::constant(100)));
  return plus(six, times(chosen, minus(beyond, six)));
}

} // namespace

void MacroBlocks::guardSystem(const ir::ExpressionPtr& system, const stdlib::MacroSignature& signature,
                              bool called, const ir::Origin& origin) {
  const stdlib::MacroArgument* const target = extendedArgument(signature);
  const ExtendedSystems extended = called && target == nullptr
                                       ? ExtendedSystems()
                                       : extendedNumbers(extendedArgument(state_.options.source),
                                                         called ? target : nullptr, state_.options.control);
  if (const double* known = ir::constantValue(ir::simplify(system))) {
    if (namesSystem(*known, extended)) return;
    const SystemWords words =
        systemWords(*known, state_.options.source, state_.options.control, "write one of those");
    state_.refuse<diag::SystemRange>(origin.range(), words.number, words.remedy);
    return;
  }
  // What a variable of the control holds is for its macro to look at.
  if (called && needsControl(system)) return;
  for (const ir::VariableId id : givenFor(state_.cycle, system))
    if (const auto passes = passesNoSystem(state_.cycle, id, system, extended)) {
      const std::string& name = state_.cycle.variable(id).name;
      const SystemWords words =
          systemWords(passes->number, state_.options.source, state_.options.control,
                      "correct the checks, or what the post prints from `" + name + "`");
      state_.refuse<diag::SystemNeverNamed>(origin.range(), name, numberText(passes->given), words.number,
                                            words.remedy);
      return;
    }
  const std::string text = valueText(state_, system, origin.range(), true);
  const std::string none = text + " < 54 || " + text + " > 59 || " + text + " % 1 !== 0";
  if (extended.first == 0) return state_.errorIf(none, "the work offset is not 54 to 59", origin);
  const double beside = extended.step / 2;
  state_.errorIf("(" + none + ") && (" + text + " < " + numberText(extended.first - beside) + " || " + text +
                     " > " + numberText(extended.last + beside) + ")",
                 "there is no such work offset", origin);
}

ir::ExpressionPtr MacroBlocks::settingOf(const ir::ExpressionPtr& system, ir::Axis axis) const {
  const stdlib::SystemVariables& v = state_.options.control.variables;
  const ExtendedSystems extended =
      extendedNumbers(extendedArgument(state_.options.source), nullptr, state_.options.control);
  if (extended.first == 0) return offsetOf(system, axis);
  const auto number = [](const ir::ExpressionPtr& variable) {
    return std::get<ir::MachineVariable>(variable->node).number;
  };
  const int first = *v.extendedX + static_cast<int>(ir::indexOf(axis)) * v.axisStep;
  const ir::ExpressionPtr index = beyondIndex(minus(system, ir::constant(extended.first)), extended);
  return ir::machineVariable(either(state_, system, extended, number(offsetOf(system, axis)),
                                    plus(ir::constant(first), times(index, ir::constant(v.extendedStep)))));
}

ir::ExpressionPtr MacroBlocks::systemForCall(const ir::ExpressionPtr& system,
                                             const stdlib::MacroSignature& signature) const {
  const stdlib::MacroArgument* const target = extendedArgument(signature);
  const stdlib::MacroArgument* const source = extendedArgument(state_.options.source);
  if (target == nullptr || source == nullptr) return system;
  if (source->extendedFirst == target->extendedFirst && source->extendedStep == target->extendedStep)
    return system;
  const ExtendedSystems extended = extendedNumbers(source, target, state_.options.control);
  if (extended.first == 0) return system;
  const ir::ExpressionPtr index = beyondIndex(minus(system, ir::constant(extended.first)), extended);
  return either(state_, system, extended, system,
                plus(ir::constant(target->extendedFirst + kFirstSystem - 1),
                     times(index, ir::constant(target->extendedStep))));
}

} // namespace dotek::backends::fusion
