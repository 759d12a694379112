#include "backends/common/ExpressionPrinter.h"

namespace dotek::backends {

namespace {

// x + (-5) as x - 5.
ir::ExpressionPtr withoutSign(const ir::ExpressionPtr& expression) {
  const auto& binary = std::get<ir::Binary>(expression->node);
  const double* right = ir::constantValue(binary.right);
  const bool additive = binary.op == ir::BinaryOp::Add || binary.op == ir::BinaryOp::Subtract;
  if (right == nullptr || *right >= 0 || !additive) return expression;
  return ir::binary(binary.op == ir::BinaryOp::Add ? ir::BinaryOp::Subtract : ir::BinaryOp::Add, binary.left,
                    ir::constant(-*right, binary.right->range), expression->range);
}

// A minus goes in front of a variable only.
bool isSignedVariable(const ir::ExpressionPtr& expression) {
  const auto* unary = std::get_if<ir::Unary>(&expression->node);
  return unary != nullptr && unary->op == ir::UnaryOp::Negate &&
         std::holds_alternative<ir::VariableUse>(unary->operand->node);
}

} // namespace

ir::ExpressionPtr ExpressionPrinter::shown(const ir::ExpressionPtr& expression) const {
  if (std::holds_alternative<ir::Binary>(expression->node)) return withoutSign(expression);
  const auto* unary = std::get_if<ir::Unary>(&expression->node);
  if (unary == nullptr || isSignedVariable(expression)) return expression;
  if (unary->op == ir::UnaryOp::Negate)
    return withoutSign(
        ir::binary(ir::BinaryOp::Subtract, ir::constant(0), unary->operand, expression->range));
  if (unary->op == ir::UnaryOp::NullAsZero)
    return ir::binary(ir::BinaryOp::Add, unary->operand, ir::constant(0), expression->range);
  return expression;
}

bool ExpressionPrinter::isSigned(const ir::ExpressionPtr& expression) const {
  const double* value = ir::constantValue(expression);
  return (value != nullptr && *value < 0) || isSignedVariable(expression);
}

int ExpressionPrinter::levelOf(const ir::ExpressionPtr& expression) const {
  const auto* binary = std::get_if<ir::Binary>(&expression->node);
  if (binary == nullptr) return kAtom;
  const Infix infix = notation_.infix(binary->op);
  return infix.text.empty() ? kAtom : infix.level;
}

std::string ExpressionPrinter::negated(const ir::ExpressionPtr& operand, std::uint32_t depth) {
  return "-" + leaf(operand, depth);
}

std::string ExpressionPrinter::bracketed(const ir::ExpressionPtr& expression, std::uint32_t depth) {
  if (depth == 0) return aside(expression);
  return notation_.open() + text(expression, depth - 1, true) + notation_.close();
}

// `right`: of a left-to-right operator, so that an equal level needs brackets.
std::string ExpressionPrinter::operand(const ir::ExpressionPtr& expression, std::uint32_t depth,
                                       const Infix& infix, bool right, bool first) {
  const ir::ExpressionPtr printed = shown(expression);
  const int own = levelOf(printed);
  const bool signMayStand = !right && leftTakesSign(infix, first);
  const bool bare = isSigned(printed) ? signMayStand : right ? own > infix.level : own >= infix.level;
  return bare ? text(expression, depth, first && signMayStand) : bracketed(expression, depth);
}

std::string ExpressionPrinter::text(const ir::ExpressionPtr& expression, std::uint32_t depth, bool first) {
  const ir::ExpressionPtr printed = shown(expression);
  if (const auto* binary = std::get_if<ir::Binary>(&printed->node)) {
    const Infix infix = notation_.infix(binary->op);
    if (infix.text.empty()) return operation(*binary, expression, depth);
    std::string left = operand(binary->left, depth, infix, false, first);
    if (notation_.bracketsLeft(binary->op, left)) left = bracketed(binary->left, depth);
    return left + std::string(infix.text) + operand(binary->right, depth, infix, true, false);
  }
  const auto* unary = std::get_if<ir::Unary>(&printed->node);
  if (unary == nullptr) return leaf(printed, depth);
  if (unary->op == ir::UnaryOp::Negate) return negated(unary->operand, depth);
  const std::string_view name = notation_.function(unary->op);
  if (name.empty() || depth == 0) return aside(expression);
  return std::string(name) + notation_.open() + text(unary->operand, depth - 1, true) + notation_.close();
}

} // namespace dotek::backends
