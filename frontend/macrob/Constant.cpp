#include "frontend/macrob/Constant.h"

namespace dotek::frontend::macrob {

std::optional<double> constantOf(const Expression& expression) {
  if (const auto* number = std::get_if<nc::Number>(&expression.node)) return number->value;
  if (const auto* negated = std::get_if<nc::Negated>(&expression.node)) {
    const auto value = constantOf(*negated->operand);
    return value ? std::optional(-*value) : std::nullopt;
  }
  const auto* operation = std::get_if<nc::Operation>(&expression.node);
  if (operation == nullptr) return std::nullopt;
  const auto left = constantOf(*operation->left);
  const auto right = constantOf(*operation->right);
  // Nothing is left of a byte after AND 0.
  if ((operation->op == "AND" || operation->op == "*") && (left == 0 || right == 0)) return 0;
  if (!left || !right) return std::nullopt;
  if (operation->op == "+") return *left + *right;
  if (operation->op == "-") return *left - *right;
  if (operation->op == "*") return *left * *right;
  return std::nullopt;
}

} // namespace dotek::frontend::macrob
