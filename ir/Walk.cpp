#include "ir/Walk.h"

namespace dotek::ir {
namespace {

template <class... Types> struct Cases : Types... { using Types::operator()...; };
template <class... Types> Cases(Types...) -> Cases<Types...>; // clang 14 asks for it

// `S` is Statement or const Statement.
template <class S, class Visit> void slots(S& statement, const Visit& visit) {
  const auto slot = [&](auto& pointer) {
    if (pointer) visit(pointer);
  };
  const auto coordinate = [&](auto& place) {
    if (!place) return;
    slot(place->value);
    slot(place->system);
  };
  std::visit(
      Cases{[&](auto&) {},
            [&](std::conditional_t<std::is_const_v<S>, const Assign, Assign>& node) { slot(node.value); },
            [&](std::conditional_t<std::is_const_v<S>, const Store, Store>& node) {
              slot(node.number);
              slot(node.value);
            },
            [&](std::conditional_t<std::is_const_v<S>, const Move, Move>& node) {
              for (auto& axis : node.axes)
                coordinate(axis);
              slot(node.feed);
            },
            [&](std::conditional_t<std::is_const_v<S>, const Measure, Measure>& node) {
              coordinate(node.target);
              slot(node.diameter);
              if (!node.setting) return;
              slot(node.setting->system);
              for (auto& nominal : node.setting->nominal)
                slot(nominal);
            },
            [&](std::conditional_t<std::is_const_v<S>, const Spindle, Spindle>& node) { slot(node.speed); },
            [&](std::conditional_t<std::is_const_v<S>, const SetMode, SetMode>& node) { slot(node.system); },
            [&](std::conditional_t<std::is_const_v<S>, const Dwell, Dwell>& node) { slot(node.seconds); },
            [&](std::conditional_t<std::is_const_v<S>, const OpaqueBlock, OpaqueBlock>& node) {
              for (auto& word : node.words)
                slot(word.value);
            },
            [&](std::conditional_t<std::is_const_v<S>, const NcBlock, NcBlock>& node) {
              for (auto& word : node.words)
                slot(word.value);
            },
            [&](std::conditional_t<std::is_const_v<S>, const JumpTo, JumpTo>& node) { slot(node.number); },
            [&](std::conditional_t<std::is_const_v<S>, const Call, Call>& node) {
              slot(node.program);
              slot(node.repeats);
              for (auto& argument : node.arguments)
                slot(argument.value);
            },
            [&](std::conditional_t<std::is_const_v<S>, const Exit, Exit>& node) { slot(node.block); },
            [&](std::conditional_t<std::is_const_v<S>, const Raise, Raise>& node) { slot(node.number); },
            [&](std::conditional_t<std::is_const_v<S>, const Notice, Notice>& node) { slot(node.number); }},
      statement.node);
}

} // namespace

void eachSlot(Statement& statement, const std::function<void(ExpressionPtr&)>& visit) {
  slots(statement, visit);
}

void eachSlot(const Statement& statement, const std::function<void(const ExpressionPtr&)>& visit) {
  slots(statement, visit);
}

void eachNode(const ExpressionPtr& expression, const std::function<void(const Expression&)>& visit) {
  visit(*expression);
  if (const auto* machine = std::get_if<MachineVariable>(&expression->node)) {
    eachNode(machine->number, visit);
  } else if (const auto* one = std::get_if<Unary>(&expression->node)) {
    eachNode(one->operand, visit);
  } else if (const auto* two = std::get_if<Binary>(&expression->node)) {
    eachNode(two->left, visit);
    eachNode(two->right, visit);
  }
}

void eachNode(const ConditionPtr& condition, const std::function<void(const Expression&)>& visit) {
  if (const auto* comparison = std::get_if<Comparison>(&condition->node)) {
    eachNode(comparison->left, visit);
    eachNode(comparison->right, visit);
  } else if (const auto* null = std::get_if<IsNull>(&condition->node)) {
    eachNode(null->value, visit);
  } else if (const auto* negated = std::get_if<Not>(&condition->node)) {
    eachNode(negated->inner, visit);
  } else if (const auto* junction = std::get_if<Junction>(&condition->node)) {
    eachNode(junction->left, visit);
    eachNode(junction->right, visit);
  }
}

void eachNode(const Statement& statement, const std::function<void(const Expression&)>& visit) {
  if (const auto* branch = std::get_if<Branch>(&statement.node)) eachNode(branch->condition, visit);
  if (const auto* loop = std::get_if<Loop>(&statement.node); loop && loop->condition)
    eachNode(loop->condition, visit);
  eachSlot(statement, [&](const ExpressionPtr& slot) { eachNode(slot, visit); });
}

} // namespace dotek::ir
