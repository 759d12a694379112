// Walks over syntax trees, in the order of the text.
#pragma once

#include "frontend/gibbs/Ast.h"

namespace dotek::frontend::gibbs {

// Calls visit(const Expression&) for the expression and all inside it, outermost first.
template <class Visit> void walkExpression(const Expression& expression, const Visit& visit) {
  visit(expression);
  if (const auto* reference = std::get_if<VariableRef>(&expression.node)) {
    if (reference->index != nullptr) walkExpression(*reference->index, visit);
  } else if (const auto* call = std::get_if<FunctionCall>(&expression.node)) {
    for (const ExpressionPtr& argument : call->arguments)
      walkExpression(*argument, visit);
  } else if (const auto* unary = std::get_if<Unary>(&expression.node)) {
    walkExpression(*unary->operand, visit);
  } else if (const auto* binary = std::get_if<Binary>(&expression.node)) {
    walkExpression(*binary->left, visit);
    walkExpression(*binary->right, visit);
  } else if (const auto* bracketed = std::get_if<Bracketed>(&expression.node)) {
    walkExpression(*bracketed->inner, visit);
  }
}

template <class Visit> void walkLines(const std::vector<Line>& lines, const Visit& visit);

// Calls visit(const Statement&) for the statement and those inside an IF, outermost first.
template <class Visit> void walkStatement(const Statement& statement, const Visit& visit) {
  visit(statement);
  const auto* branch = std::get_if<If>(&statement.node);
  if (branch == nullptr) return;
  if (branch->then != nullptr) walkStatement(*branch->then, visit);
  walkLines(branch->thenBlock, visit);
  if (branch->elseStatement != nullptr) walkStatement(*branch->elseStatement, visit);
  walkLines(branch->elseBlock, visit);
}

template <class Visit> void walkLines(const std::vector<Line>& lines, const Visit& visit) {
  for (const Line& line : lines)
    if (line.statement != nullptr) walkStatement(*line.statement, visit);
}

// Calls visit(const Expression&) for each outermost expression of one statement; those of statements inside
// an IF are not its own. Targets of assignments and declared names are no expressions, their indices are.
template <class Visit> void ownExpressions(const Statement& statement, const Visit& visit) {
  const auto some = [&](const ExpressionPtr& expression) {
    if (expression != nullptr) visit(*expression);
  };
  const auto indices = [&](const std::vector<VariableRef>& names) {
    for (const VariableRef& name : names)
      some(name.index);
  };
  if (const auto* assign = std::get_if<Assignment>(&statement.node)) {
    some(assign->target.index);
    some(assign->value);
  } else if (const auto* branch = std::get_if<If>(&statement.node)) {
    for (const Comparison& comparison : branch->condition.comparisons) {
      some(comparison.left);
      some(comparison.right);
    }
  } else if (const auto* loop = std::get_if<For>(&statement.node)) {
    some(loop->from);
    some(loop->to);
    some(loop->step);
  } else if (const auto* call = std::get_if<CallMacro>(&statement.node)) {
    some(call->macro);
    for (const ExpressionPtr& argument : call->arguments)
      some(argument);
  } else if (const auto* args = std::get_if<Args>(&statement.node)) {
    indices(args->names);
  } else if (const auto* declared = std::get_if<Declaration>(&statement.node)) {
    indices(declared->names);
  } else if (const auto* command = std::get_if<Command>(&statement.node)) {
    for (const ExpressionPtr& argument : command->arguments)
      some(argument);
  } else if (const auto* block = std::get_if<std::unique_ptr<GeometryBlock>>(&statement.node)) {
    for (const Command& element : (*block)->elements)
      for (const ExpressionPtr& argument : element.arguments)
        some(argument);
  }
}

} // namespace dotek::frontend::gibbs
