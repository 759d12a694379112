#include "frontend/macrob/Walk.h"

#include <cmath>

namespace dotek::frontend::macrob {

void walk(const Expression& expression, const VisitExpression& visit, bool subscript) {
  visit(expression, subscript);
  if (const auto* variable = std::get_if<nc::VariableRef>(&expression.node)) {
    walk(*variable->number, visit, true);
  } else if (const auto* negated = std::get_if<nc::Negated>(&expression.node)) {
    walk(*negated->operand, visit, subscript);
  } else if (const auto* operation = std::get_if<nc::Operation>(&expression.node)) {
    walk(*operation->left, visit, subscript);
    walk(*operation->right, visit, subscript);
  } else if (const auto* call = std::get_if<nc::FunctionCall>(&expression.node)) {
    for (const ExpressionPtr& argument : call->arguments)
      walk(*argument, visit, subscript);
  }
}

void walk(const Condition& condition, const VisitExpression& visit) {
  if (const auto* comparison = std::get_if<Comparison>(&condition.node)) {
    walk(*comparison->left, visit);
    walk(*comparison->right, visit);
  } else if (const auto* joined = std::get_if<JoinedConditions>(&condition.node)) {
    walk(*joined->left, visit);
    walk(*joined->right, visit);
  }
}

void walk(const Block& block, const VisitExpression& visit) {
  if (const auto* words = std::get_if<Words>(&block.body))
    for (const nc::Word& word : words->words)
      if (word.value != nullptr) walk(*word.value, visit);
  if (const Condition* condition = conditionOf(block)) walk(*condition, visit);
  if (const nc::Assignment* assignment = assignmentOf(block)) {
    walk(*assignment->variable, visit, true);
    walk(*assignment->value, visit);
  }
  if (const Goto* jump = gotoOf(block)) walk(*jump->target, visit);
}

void eachComparison(const Condition& condition,
                    const std::function<void(const Comparison& comparison, SourceRange range)>& visit) {
  if (const auto* both = std::get_if<JoinedConditions>(&condition.node)) {
    eachComparison(*both->left, visit);
    eachComparison(*both->right, visit);
  } else {
    visit(std::get<Comparison>(condition.node), condition.range);
  }
}

const nc::Assignment* assignmentOf(const Block& block) {
  if (const auto* branch = std::get_if<If>(&block.body))
    return std::get_if<nc::Assignment>(&branch->statement);
  return std::get_if<nc::Assignment>(&block.body);
}

const Goto* gotoOf(const Block& block) {
  if (const auto* branch = std::get_if<If>(&block.body)) return std::get_if<Goto>(&branch->statement);
  return std::get_if<Goto>(&block.body);
}

const Condition* conditionOf(const Block& block) {
  if (const auto* branch = std::get_if<If>(&block.body)) return branch->condition.get();
  if (const auto* loop = std::get_if<Do>(&block.body)) return loop->condition.get();
  return nullptr;
}

std::optional<std::uint32_t> variableNumber(const Expression& expression) {
  const auto* variable = std::get_if<nc::VariableRef>(&expression.node);
  if (variable == nullptr) return std::nullopt;
  const auto* number = std::get_if<nc::Number>(&variable->number->node);
  if (number == nullptr || number->value < 0 || number->value > 999999 ||
      number->value != std::floor(number->value))
    return std::nullopt;
  return static_cast<std::uint32_t>(number->value);
}

} // namespace dotek::frontend::macrob
