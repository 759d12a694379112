#include "ir/Walk.h"

#include <cmath>

namespace dotek::ir {
namespace {

// `statement` is const or not, and so is what `visit` gets.
template <class Statement, class Visit> void slots(Statement& statement, const Visit& visit) {
  const auto slot = [&](auto& pointer) {
    if (pointer) visit(pointer);
  };
  const auto coordinate = [&](auto& place) {
    if (!place) return;
    slot(place->value);
    slot(place->system);
  };
  match(
      statement, [&](OneOf<Assign> auto& node) { slot(node.value); },
      [&](OneOf<Store> auto& node) {
        slot(node.number);
        slot(node.value);
      },
      [&](OneOf<Move> auto& node) {
        for (auto& axis : node.axes)
          coordinate(axis);
        slot(node.feed);
      },
      [&](OneOf<Measure> auto& node) {
        coordinate(node.target);
        slot(node.diameter);
        if (!node.setting) return;
        slot(node.setting->system);
        for (auto& nominal : node.setting->nominal)
          slot(nominal);
      },
      [&](OneOf<CallCycle> auto& node) {
        for (auto& argument : node.arguments)
          slot(argument.value);
        if (!node.setting) return;
        slot(node.setting->system);
        for (auto& nominal : node.setting->nominal)
          slot(nominal);
      },
      [&](OneOf<Spindle> auto& node) { slot(node.speed); },
      [&](OneOf<SetMode> auto& node) { slot(node.system); },
      [&](OneOf<Dwell> auto& node) { slot(node.seconds); },
      [&](OneOf<OpaqueBlock, NcBlock> auto& node) {
        for (auto& word : node.words)
          slot(word.value);
      },
      [&](OneOf<JumpTo, Raise, Notice> auto& node) { slot(node.number); },
      [&](OneOf<Call> auto& node) {
        slot(node.program);
        slot(node.repeats);
        for (auto& argument : node.arguments)
          slot(argument.value);
      },
      [&](OneOf<Exit> auto& node) { slot(node.block); },
      [](const OneOf<Label, Jump, Branch, Return, ProbePower, Coolant, Stop, Alarm, Comment, Loop, LoopEnd,
                     Port, Print, NameVariables> auto&) {});
}

// `Condition` is ConditionPtr, const or not.
template <class Condition, class Statement> Condition* conditionIn(Statement& statement) {
  return match(
      statement, [](OneOf<Branch> auto& node) -> Condition* { return &node.condition; },
      [](OneOf<Loop> auto& node) -> Condition* { return node.condition ? &node.condition : nullptr; },
      [](const OneOf<Assign, Store, Label, Jump, Return, Move, Measure, CallCycle, ProbePower, Spindle,
                     Coolant, SetMode, Dwell, Stop, Alarm, Comment, OpaqueBlock, NcBlock, JumpTo, LoopEnd,
                     Call, Exit, Raise, Notice, Port, Print, NameVariables> auto&) -> Condition* {
        return nullptr;
      });
}

template <class Statement>
void nodesOf(const Statement& statement, const std::function<void(const Expression&)>& visit) {
  if (const ConditionPtr* condition = conditionIn<const ConditionPtr>(statement)) eachNode(*condition, visit);
  slots(statement, [&](const ExpressionPtr& slot) { eachNode(slot, visit); });
}

} // namespace

void eachSlot(CycleStatement& statement, const std::function<void(ExpressionPtr&)>& visit) {
  slots(statement, visit);
}

void eachSlot(const CycleStatement& statement, const std::function<void(const ExpressionPtr&)>& visit) {
  slots(statement, visit);
}

void eachSlot(ProgramStatement& statement, const std::function<void(ExpressionPtr&)>& visit) {
  slots(statement, visit);
}

void eachSlot(const ProgramStatement& statement, const std::function<void(const ExpressionPtr&)>& visit) {
  slots(statement, visit);
}

ConditionPtr* conditionOf(CycleStatement& statement) {
  return conditionIn<ConditionPtr>(statement);
}

const ConditionPtr* conditionOf(const CycleStatement& statement) {
  return conditionIn<const ConditionPtr>(statement);
}

ConditionPtr* conditionOf(ProgramStatement& statement) {
  return conditionIn<ConditionPtr>(statement);
}

const ConditionPtr* conditionOf(const ProgramStatement& statement) {
  return conditionIn<const ConditionPtr>(statement);
}

void eachNode(const CycleStatement& statement, const std::function<void(const Expression&)>& visit) {
  nodesOf(statement, visit);
}

void eachNode(const ProgramStatement& statement, const std::function<void(const Expression&)>& visit) {
  nodesOf(statement, visit);
}

void eachNode(const ExpressionPtr& expression, const std::function<void(const Expression&)>& visit) {
  visit(*expression);
  // Most are constants, and variables with a written number.
  if (std::holds_alternative<Constant>(expression->node)) return;
  if (const auto* variable = std::get_if<MachineVariable>(&expression->node)) {
    eachNode(variable->number, visit);
    return;
  }
  match(
      *expression, [&](const MachineVariable& node) { eachNode(node.number, visit); },
      [&](const Unary& node) { eachNode(node.operand, visit); },
      [&](const Binary& node) {
        eachNode(node.left, visit);
        eachNode(node.right, visit);
      },
      [](const OneOf<Constant, NullValue, VariableUse, MeasuredResult> auto&) {});
}

void eachNode(const ConditionPtr& condition, const std::function<void(const Expression&)>& visit) {
  match(
      *condition,
      [&](const Comparison& node) {
        eachNode(node.left, visit);
        eachNode(node.right, visit);
      },
      [&](const IsNull& node) { eachNode(node.value, visit); },
      [&](const Not& node) { eachNode(node.inner, visit); },
      [&](const Junction& node) {
        eachNode(node.left, visit);
        eachNode(node.right, visit);
      },
      [](const Truth&) {});
}

std::optional<std::uint32_t> firstNumber(const ExpressionPtr& number) {
  const auto* sum = std::get_if<Binary>(&number->node);
  if (sum == nullptr || sum->op != BinaryOp::Add) return std::nullopt;
  std::optional<double> out;
  const auto add = [&](const auto& self, const ExpressionPtr& term) -> void {
    const auto* inner = std::get_if<Binary>(&term->node);
    if (inner != nullptr && inner->op == BinaryOp::Add) {
      self(self, inner->left);
      self(self, inner->right);
    } else if (const double* value = constantValue(term)) {
      out = out.value_or(0) + *value;
    }
  };
  add(add, number);
  if (!out || !(*out >= 0 && *out <= 99999999)) return std::nullopt;
  return static_cast<std::uint32_t>(std::lround(*out));
}

} // namespace dotek::ir
