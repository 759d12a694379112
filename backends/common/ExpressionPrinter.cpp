#include "backends/common/ExpressionPrinter.h"

namespace dotek::backends {

namespace {

constexpr int kAtom = 100;

// x + (-5) is printed as x - 5.
ir::Binary withoutSign(const ir::Binary& binary) {
  const double* right = ir::constantValue(binary.right);
  const bool additive = binary.op == ir::BinaryOp::Add || binary.op == ir::BinaryOp::Subtract;
  if (right == nullptr || *right >= 0 || !additive) return binary;
  return {binary.op == ir::BinaryOp::Add ? ir::BinaryOp::Subtract : ir::BinaryOp::Add, binary.left,
          ir::constant(-*right, binary.right->range)};
}

bool isNegativeConstant(const ir::ExpressionPtr& expression) {
  const double* value = ir::constantValue(expression);
  return value != nullptr && *value < 0;
}

// A minus goes in front of a variable only.
bool isSignedVariable(const ir::ExpressionPtr& expression) {
  const auto* unary = std::get_if<ir::Unary>(&expression->node);
  return unary != nullptr && unary->op == ir::UnaryOp::Negate &&
         std::holds_alternative<ir::VariableUse>(unary->operand->node);
}

} // namespace

int ExpressionPrinter::levelOf(const ir::ExpressionPtr& expression) const {
  if (isNegativeConstant(expression) || isSignedVariable(expression)) return 0; // signed
  if (const auto* binary = std::get_if<ir::Binary>(&expression->node)) {
    const Infix infix = notation_.infix(binary->op);
    return infix.text.empty() ? kAtom : infix.level;
  }
  if (const auto* unary = std::get_if<ir::Unary>(&expression->node))
    if (unary->op == ir::UnaryOp::Negate || unary->op == ir::UnaryOp::NullAsZero) return kAdditive;
  return kAtom;
}

std::string ExpressionPrinter::bracketed(const ir::ExpressionPtr& expression, std::uint32_t depth) {
  if (depth == 0) return aside(expression);
  return notation_.open() + print(expression, depth - 1) + notation_.close();
}

// `right`: of a left-to-right operator, so that an equal level needs brackets.
std::string ExpressionPrinter::operand(const ir::ExpressionPtr& expression, std::uint32_t depth, int level,
                                       bool right) {
  const int own = levelOf(expression);
  // A sign may begin the whole expression, not stand behind an operator.
  const bool bare = own == 0 ? !right && level == kAdditive : right ? own > level : own >= level;
  return bare ? print(expression, depth) : bracketed(expression, depth);
}

std::string ExpressionPrinter::function(const ir::Unary& unary, const ir::ExpressionPtr& whole,
                                        std::uint32_t depth) {
  const std::string_view name = notation_.function(unary.op);
  if (name.empty() || depth == 0) return aside(whole);
  return std::string(name) + notation_.open() + print(unary.operand, depth - 1) + notation_.close();
}

std::string ExpressionPrinter::sum(const ir::Binary& given, const ir::ExpressionPtr& whole,
                                   std::uint32_t depth) {
  const ir::Binary binary = withoutSign(given);
  const Infix infix = notation_.infix(binary.op);
  if (infix.text.empty()) return aside(whole);
  std::string left = operand(binary.left, depth, infix.level, false);
  return left + std::string(infix.text) + operand(binary.right, depth, infix.level, true);
}

std::string ExpressionPrinter::print(const ir::ExpressionPtr& expression, std::uint32_t depth) {
  if (const auto* binary = std::get_if<ir::Binary>(&expression->node)) return sum(*binary, expression, depth);
  const auto* unary = std::get_if<ir::Unary>(&expression->node);
  if (unary == nullptr) return leaf(expression, depth);
  if (unary->op == ir::UnaryOp::Negate) {
    if (isSignedVariable(expression)) return "-" + leaf(unary->operand, depth);
    const auto zero = ir::constant(0);
    return sum({ir::BinaryOp::Subtract, zero, unary->operand}, expression, depth);
  }
  // Null counts as 0 in a sum.
  if (unary->op == ir::UnaryOp::NullAsZero)
    return sum({ir::BinaryOp::Add, unary->operand, ir::constant(0)}, expression, depth);
  return function(*unary, expression, depth);
}

} // namespace dotek::backends
