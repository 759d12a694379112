#include "ir/Rewrite.h"

#include "ir/Walk.h"

namespace dotek::ir {
namespace {

template <class... Types> struct Cases : Types... { using Types::operator()...; };
template <class... Types> Cases(Types...) -> Cases<Types...>; // clang 14 asks for it

} // namespace

ExpressionPtr rewrite(const ExpressionPtr& expression, const Rewriter& rewriter) {
  if (const auto* one = std::get_if<Unary>(&expression->node)) {
    const ExpressionPtr operand = rewrite(one->operand, rewriter);
    return rewriter(operand == one->operand ? expression : unary(one->op, operand, expression->range));
  }
  if (const auto* two = std::get_if<Binary>(&expression->node)) {
    const ExpressionPtr left = rewrite(two->left, rewriter);
    const ExpressionPtr right = rewrite(two->right, rewriter);
    const bool same = left == two->left && right == two->right;
    return rewriter(same ? expression : binary(two->op, left, right, expression->range));
  }
  if (const auto* machine = std::get_if<MachineVariable>(&expression->node)) {
    const ExpressionPtr number = rewrite(machine->number, rewriter);
    if (number == machine->number) return rewriter(expression);
    return rewriter(
        std::make_shared<const Expression>(Expression{expression->range, MachineVariable{number}}));
  }
  return rewriter(expression);
}

ConditionPtr rewrite(const ConditionPtr& condition, const Rewriter& rewriter) {
  return std::visit(
      Cases{[&](const Comparison& c) {
              return compare(c.relation, rewrite(c.left, rewriter), rewrite(c.right, rewriter),
                             condition->range);
            },
            [&](const IsNull& c) { return isNull(rewrite(c.value, rewriter), condition->range); },
            [&](const Not& c) {
              return std::make_shared<const Condition>(
                  Condition{condition->range, Not{rewrite(c.inner, rewriter)}});
            },
            [&](const Junction& c) {
              return join(c.op, rewrite(c.left, rewriter), rewrite(c.right, rewriter), condition->range);
            },
            [&](const Truth&) { return condition; }},
      condition->node);
}

void rewrite(Statement& statement, const Rewriter& rewriter) {
  eachSlot(statement, [&](ExpressionPtr& slot) { slot = rewrite(slot, rewriter); });
  if (auto* branch = std::get_if<Branch>(&statement.node))
    branch->condition = rewrite(branch->condition, rewriter);
  if (auto* loop = std::get_if<Loop>(&statement.node); loop != nullptr && loop->condition)
    loop->condition = rewrite(loop->condition, rewriter);
}

void rename(std::vector<Statement>& list, const std::map<VariableId, VariableId>& names) {
  const Rewriter renamed = [&](const ExpressionPtr& expression) {
    const auto* use = std::get_if<VariableUse>(&expression->node);
    const auto found = use == nullptr ? names.end() : names.find(use->variable);
    return found == names.end() ? expression : variable(found->second, expression->range);
  };
  for (Statement& statement : list) {
    rewrite(statement, renamed);
    if (auto* assign = std::get_if<Assign>(&statement.node)) {
      if (const auto found = names.find(assign->variable); found != names.end())
        assign->variable = found->second;
    }
  }
}

std::set<double> constantsOf(const std::vector<Statement>& list) {
  std::set<double> out;
  for (const Statement& statement : list)
    eachNode(statement, [&](const Expression& node) {
      if (const auto* constant = std::get_if<Constant>(&node.node)) out.insert(constant->value);
    });
  return out;
}

} // namespace dotek::ir
