#include "ir/Fold.h"
#include "ir/Substitute.h"

#include <utility>

namespace dotek::ir {
namespace {

bool isNullValue(const ExpressionPtr& expression) {
  return std::holds_alternative<NullValue>(expression->node);
}

bool isConstant(const ExpressionPtr& expression, double value) {
  const double* known = constantValue(expression);
  return known && *known == value;
}

// The operand where `expression` is `op` of something, else nullptr.
const ExpressionPtr* operandOf(const ExpressionPtr& expression, UnaryOp op) {
  const auto* node = std::get_if<Unary>(&expression->node);
  return node && node->op == op ? &node->operand : nullptr;
}

// A number whatever the variables are, if it has a value at all.
bool neverNull(const ExpressionPtr& expression) {
  if (std::holds_alternative<Constant>(expression->node) || std::holds_alternative<Unary>(expression->node))
    return true;
  const auto* node = std::get_if<Binary>(&expression->node);
  return node && (node->op != BinaryOp::ValueOr || neverNull(node->left) || neverNull(node->right));
}

bool fixed(const ExpressionPtr& expression) {
  return std::holds_alternative<Constant>(expression->node) || isNullValue(expression);
}

// The expression as a constant where all operands are; itself where arithmetic fails.
ExpressionPtr computed(ExpressionPtr expression) {
  const Scalar value = evaluate(*expression, {});
  if (value.known()) return constant(value.value, expression->range);
  return value.state == Scalar::State::Null ? nullValue(expression->range) : expression;
}

ExpressionPtr simplifiedUnary(const ExpressionPtr& whole, const Unary& node) {
  if (node.op == UnaryOp::NullAsZero && neverNull(node.operand)) return node.operand;
  if (node.op == UnaryOp::Negate) {
    if (const auto* inner = operandOf(node.operand, UnaryOp::Negate)) return *inner;
    const auto* literal = std::get_if<Constant>(&node.operand->node);
    if (literal && literal->value != 0 && !literal->digits.empty()) {
      const std::string& digits = literal->digits;
      return constant(-literal->value, whole->range, digits.front() == '-' ? digits.substr(1) : "-" + digits);
    }
  }
  return fixed(node.operand) ? computed(whole) : whole;
}

// `operand` is simplified.
ExpressionPtr negated(const ExpressionPtr& operand, SourceRange range) {
  const ExpressionPtr whole = unary(UnaryOp::Negate, operand, range);
  return simplifiedUnary(whole, std::get<Unary>(whole->node));
}

// Only what is exact in doubles: (a + 1) + 2 stays.
ExpressionPtr simplifiedBinary(const ExpressionPtr& whole, const Binary& node) {
  const ExpressionPtr& a = node.left;
  const ExpressionPtr& b = node.right;
  if (node.op == BinaryOp::ValueOr) {
    if (isNullValue(a)) return b;
    return isNullValue(b) || neverNull(a) ? a : whole;
  }
  if (isNullValue(a) || isNullValue(b)) return whole;
  const SourceRange range = whole->range;
  switch (node.op) {
  case BinaryOp::Add:
    if (isConstant(b, 0)) return a;
    if (isConstant(a, 0)) return b;
    if (const auto* inner = operandOf(b, UnaryOp::Negate))
      return binary(BinaryOp::Subtract, a, *inner, range);
    break;
  case BinaryOp::Subtract:
    if (isConstant(b, 0)) return a;
    if (isConstant(a, 0)) return negated(b, range);
    if (const auto* inner = operandOf(b, UnaryOp::Negate)) return binary(BinaryOp::Add, a, *inner, range);
    break;
  case BinaryOp::Multiply:
    if (isConstant(b, 1)) return a;
    if (isConstant(a, 1)) return b;
    if (isConstant(b, -1)) return negated(a, range);
    if (isConstant(a, -1)) return negated(b, range);
    break;
  case BinaryOp::Divide:
    if (isConstant(b, 1)) return a;
    if (isConstant(b, -1)) return negated(a, range);
    break;
  case BinaryOp::Modulo:
  case BinaryOp::Direction:
  case BinaryOp::BitAnd:
  case BinaryOp::BitOr:
  case BinaryOp::BitXor:
  case BinaryOp::ValueOr:
  case BinaryOp::RoundedAnd:
  case BinaryOp::RoundedOr:
  case BinaryOp::RoundedXor:
  case BinaryOp::RoundedModulo:
  case BinaryOp::Power:
  case BinaryOp::Bearing: break;
  }
  return fixed(a) && fixed(b) ? computed(whole) : whole;
}

// The operand of arithmetic, which is never Null: a variable that is keeps its name there.
ExpressionPtr operand(const ExpressionPtr& expression, const Environment& environment) {
  ExpressionPtr out = substitute(expression, environment);
  return isNullValue(out) ? expression : out;
}

ExpressionPtr substitutedUse(const ExpressionPtr& whole, const VariableUse& node,
                             const Environment& environment) {
  if (node.variable >= environment.size()) return whole;
  const Scalar& value = environment[node.variable];
  if (value.known()) return constant(value.value, whole->range);
  return value.state == Scalar::State::Null ? nullValue(whole->range) : whole;
}

ConditionPtr simplifiedJunction(const ConditionPtr& whole, const Junction& node) {
  const bool deciding = node.op == Connective::Or;
  for (const auto& [side, other] : {std::pair(node.left, node.right), std::pair(node.right, node.left)})
    if (const auto* known = std::get_if<Truth>(&side->node)) return known->value == deciding ? side : other;
  return whole;
}

ConditionPtr decided(ConditionPtr condition) {
  const auto value = holds(*condition, {});
  return value ? truth(*value, condition->range) : condition;
}

} // namespace

ExpressionPtr substitute(const ExpressionPtr& expression, const Environment& environment) {
  if (const auto* use = std::get_if<VariableUse>(&expression->node))
    return substitutedUse(expression, *use, environment);
  const SourceRange range = expression->range;
  if (const auto* node = std::get_if<MachineVariable>(&expression->node)) {
    ExpressionPtr number = operand(node->number, environment);
    return number == node->number ? expression : machineVariable(std::move(number), range);
  }
  if (const auto* node = std::get_if<Unary>(&expression->node)) {
    ExpressionPtr inner = node->op == UnaryOp::NullAsZero ? substitute(node->operand, environment)
                                                          : operand(node->operand, environment);
    const ExpressionPtr whole =
        inner == node->operand ? expression : unary(node->op, std::move(inner), range);
    return simplifiedUnary(whole, std::get<Unary>(whole->node));
  }
  if (const auto* node = std::get_if<Binary>(&expression->node)) {
    const bool nullable = node->op == BinaryOp::ValueOr;
    ExpressionPtr left = nullable ? substitute(node->left, environment) : operand(node->left, environment);
    ExpressionPtr right = nullable ? substitute(node->right, environment) : operand(node->right, environment);
    const ExpressionPtr whole = left == node->left && right == node->right
                                    ? expression
                                    : binary(node->op, std::move(left), std::move(right), range);
    return simplifiedBinary(whole, std::get<Binary>(whole->node));
  }
  return expression;
}

ConditionPtr substitute(const ConditionPtr& condition, const Environment& environment) {
  const SourceRange range = condition->range;
  if (const auto* node = std::get_if<Comparison>(&condition->node)) {
    ExpressionPtr left = operand(node->left, environment);
    ExpressionPtr right = operand(node->right, environment);
    const bool same = left == node->left && right == node->right;
    return decided(same ? condition : compare(node->relation, std::move(left), std::move(right), range));
  }
  if (const auto* node = std::get_if<IsNull>(&condition->node)) {
    ExpressionPtr value = substitute(node->value, environment);
    if (neverNull(value) && !mayFail(value)) return truth(false, range);
    return decided(value == node->value ? condition : isNull(std::move(value), range));
  }
  if (const auto* node = std::get_if<Not>(&condition->node)) {
    ConditionPtr inner = substitute(node->inner, environment);
    if (inner == node->inner && std::holds_alternative<IsNull>(inner->node)) return condition;
    return negate(inner);
  }
  if (const auto* node = std::get_if<Junction>(&condition->node)) {
    ConditionPtr left = substitute(node->left, environment);
    ConditionPtr right = substitute(node->right, environment);
    const ConditionPtr whole = left == node->left && right == node->right
                                   ? condition
                                   : join(node->op, std::move(left), std::move(right), range);
    return simplifiedJunction(whole, std::get<Junction>(whole->node));
  }
  return condition;
}

ExpressionPtr simplify(const ExpressionPtr& expression) {
  return substitute(expression, {});
}

ConditionPtr simplify(const ConditionPtr& condition) {
  return substitute(condition, {});
}

bool mayFail(const ExpressionPtr& expression) {
  if (const auto* node = std::get_if<MachineVariable>(&expression->node)) return mayFail(node->number);
  if (const auto* node = std::get_if<Unary>(&expression->node)) {
    switch (node->op) {
    case UnaryOp::SquareRoot:
    case UnaryOp::Tangent:
    case UnaryOp::ArcSine:
    case UnaryOp::ArcCosine:
    case UnaryOp::Logarithm:
    case UnaryOp::Exponential:
    case UnaryOp::FromBcd:
    case UnaryOp::ToBcd:
    case UnaryOp::RoundIncrement:
    case UnaryOp::AddPoint: return true;
    case UnaryOp::Negate:
    case UnaryOp::Absolute:
    case UnaryOp::Truncate:
    case UnaryOp::RoundUp:
    case UnaryOp::Round:
    case UnaryOp::Sine:
    case UnaryOp::Cosine:
    case UnaryOp::ArcTangent:
    case UnaryOp::NullAsZero: return mayFail(node->operand);
    }
  }
  if (const auto* node = std::get_if<Binary>(&expression->node)) {
    if (mayFail(node->left) || mayFail(node->right)) return true;
    switch (node->op) {
    case BinaryOp::Divide:
    case BinaryOp::Modulo: {
      const double* divisor = constantValue(node->right);
      return !divisor || *divisor == 0;
    }
    case BinaryOp::Direction:
    case BinaryOp::BitAnd:
    case BinaryOp::BitOr:
    case BinaryOp::BitXor:
    case BinaryOp::RoundedAnd:
    case BinaryOp::RoundedOr:
    case BinaryOp::RoundedXor:
    case BinaryOp::RoundedModulo: // a divisor of 0.3 is rounded to 0
    case BinaryOp::Power:
    case BinaryOp::Bearing: return true;
    case BinaryOp::Add:
    case BinaryOp::Subtract:
    case BinaryOp::Multiply:
    case BinaryOp::ValueOr: return false;
    }
  }
  return false;
}

bool mayFail(const ConditionPtr& condition) {
  if (const auto* node = std::get_if<Comparison>(&condition->node))
    return mayFail(node->left) || mayFail(node->right);
  if (const auto* node = std::get_if<IsNull>(&condition->node)) return mayFail(node->value);
  if (const auto* node = std::get_if<Not>(&condition->node)) return mayFail(node->inner);
  if (const auto* node = std::get_if<Junction>(&condition->node))
    return mayFail(node->left) || mayFail(node->right);
  return false;
}

} // namespace dotek::ir
