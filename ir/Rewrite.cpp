#include "ir/Rewrite.h"

#include "ir/Walk.h"

namespace dotek::ir {
namespace {

template <class Statement> void rewriteStatement(Statement& statement, const Rewriter& rewriter) {
  eachSlot(statement, [&](ExpressionPtr& slot) { slot = rewrite(slot, rewriter); });
  if (ConditionPtr* condition = conditionOf(statement)) *condition = rewrite(*condition, rewriter);
}

} // namespace

ExpressionPtr rewrite(const ExpressionPtr& expression, const Rewriter& rewriter) {
  return match(
      *expression,
      [&](const Unary& node) {
        const ExpressionPtr operand = rewrite(node.operand, rewriter);
        return rewriter(operand == node.operand ? expression : unary(node.op, operand, expression->range));
      },
      [&](const Binary& node) {
        const ExpressionPtr left = rewrite(node.left, rewriter);
        const ExpressionPtr right = rewrite(node.right, rewriter);
        const bool same = left == node.left && right == node.right;
        return rewriter(same ? expression : binary(node.op, left, right, expression->range));
      },
      [&](const MachineVariable& node) {
        const ExpressionPtr number = rewrite(node.number, rewriter);
        if (number == node.number) return rewriter(expression);
        return rewriter(
            std::make_shared<const Expression>(Expression{expression->range, MachineVariable{number}}));
      },
      [&](const OneOf<Constant, NullValue, VariableUse, MeasuredResult> auto&) {
        return rewriter(expression);
      });
}

ConditionPtr rewrite(const ConditionPtr& condition, const Rewriter& rewriter) {
  return match(
      *condition,
      [&](const Comparison& c) {
        return compare(c.relation, rewrite(c.left, rewriter), rewrite(c.right, rewriter), condition->range);
      },
      [&](const IsNull& c) { return isNull(rewrite(c.value, rewriter), condition->range); },
      [&](const Not& c) {
        return std::make_shared<const Condition>(
            Condition{condition->range, Not{rewrite(c.inner, rewriter)}});
      },
      [&](const Junction& c) {
        return join(c.op, rewrite(c.left, rewriter), rewrite(c.right, rewriter), condition->range);
      },
      [&](const Truth&) { return condition; });
}

void rewrite(CycleStatement& statement, const Rewriter& rewriter) {
  rewriteStatement(statement, rewriter);
}

void rewrite(ProgramStatement& statement, const Rewriter& rewriter) {
  rewriteStatement(statement, rewriter);
}

void rename(std::vector<CycleStatement>& list, const std::map<VariableId, VariableId>& names) {
  const Rewriter renamed = [&](const ExpressionPtr& expression) {
    const auto* use = std::get_if<VariableUse>(&expression->node);
    const auto found = use == nullptr ? names.end() : names.find(use->variable);
    return found == names.end() ? expression : variable(found->second, expression->range);
  };
  for (CycleStatement& statement : list) {
    rewrite(statement, renamed);
    if (auto* assign = std::get_if<Assign>(&statement.node)) {
      if (const auto found = names.find(assign->variable); found != names.end())
        assign->variable = found->second;
    }
  }
}

std::set<double> constantsOf(const std::vector<CycleStatement>& list) {
  std::set<double> out;
  for (const CycleStatement& statement : list)
    eachNode(statement, [&](const Expression& node) {
      if (const auto* constant = std::get_if<Constant>(&node.node)) out.insert(constant->value);
    });
  return out;
}

} // namespace dotek::ir
