#include "frontend/macrob/Walk.h"

#include <cmath>

namespace dotek::frontend::macrob {

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
