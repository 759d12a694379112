#include "frontend/macrob/LowerExpression.h"

#include <array>
#include <string_view>
#include <utility>

namespace dotek::frontend::macrob {
namespace {

using ir::BinaryOp;
using ir::UnaryOp;

ir::ExpressionPtr orZero(ir::ExpressionPtr value) {
  const SourceRange range = value->range;
  return std::holds_alternative<ir::MachineVariable>(value->node)
             ? ir::unary(UnaryOp::NullAsZero, std::move(value), range)
             : value;
}

struct FunctionName {
  std::string_view name;
  UnaryOp op;
};
constexpr std::array kFunctions = {
    FunctionName{"SIN", UnaryOp::Sine},        FunctionName{"COS", UnaryOp::Cosine},
    FunctionName{"TAN", UnaryOp::Tangent},     FunctionName{"ASIN", UnaryOp::ArcSine},
    FunctionName{"ACOS", UnaryOp::ArcCosine},  FunctionName{"ATAN", UnaryOp::ArcTangent},
    FunctionName{"SQRT", UnaryOp::SquareRoot}, FunctionName{"SQR", UnaryOp::SquareRoot},
    FunctionName{"ABS", UnaryOp::Absolute},    FunctionName{"FIX", UnaryOp::Truncate},
    FunctionName{"FUP", UnaryOp::RoundUp},     FunctionName{"LN", UnaryOp::Logarithm},
    FunctionName{"EXP", UnaryOp::Exponential}, FunctionName{"BIN", UnaryOp::FromBcd},
    FunctionName{"BCD", UnaryOp::ToBcd},       FunctionName{"ADP", UnaryOp::AddPoint},
};

ir::ExpressionPtr function(const nc::FunctionCall& call, Place place, SourceRange range) {
  ir::ExpressionPtr first = lowerNumber(*call.arguments.front(), place);
  if (call.arguments.size() > 1) {
    ir::ExpressionPtr second = lowerNumber(*call.arguments[1], place);
    if (call.name == "POW") return ir::binary(BinaryOp::Power, first, second, range);
    return ir::binary(BinaryOp::Bearing, second, first, range); // ATAN[y]/[x]
  }
  if (call.name == "ROUND")
    return ir::unary(place == Place::Word ? UnaryOp::RoundIncrement : UnaryOp::Round, first, range);
  for (const FunctionName& known : kFunctions)
    if (known.name == call.name) return ir::unary(known.op, first, range);
  return first; // the parser knows no other
}

BinaryOp operatorOf(std::string_view op) {
  if (op == "+") return BinaryOp::Add;
  if (op == "-") return BinaryOp::Subtract;
  if (op == "*") return BinaryOp::Multiply;
  if (op == "/") return BinaryOp::Divide;
  if (op == "MOD") return BinaryOp::RoundedModulo;
  if (op == "AND") return BinaryOp::RoundedAnd;
  return op == "OR" ? BinaryOp::RoundedOr : BinaryOp::RoundedXor;
}

} // namespace

ir::ExpressionPtr lowerValue(const Expression& expression, Place place) {
  const SourceRange range = expression.range;
  if (const auto* number = std::get_if<nc::Number>(&expression.node))
    return ir::constant(number->value, range, number->digits);
  if (const auto* variable = std::get_if<nc::VariableRef>(&expression.node)) {
    ir::ExpressionPtr value = ir::machineVariable(lowerNumber(*variable->number, Place::Statement), range);
    return expression.brackets > 0 ? orZero(std::move(value)) : value;
  }
  if (const auto* negated = std::get_if<nc::Negated>(&expression.node)) {
    const auto* number = std::get_if<nc::Number>(&negated->operand->node);
    if (number != nullptr && negated->operand->brackets == 0 && number->value != 0)
      return ir::constant(-number->value, range, "-" + number->digits);
    return ir::unary(UnaryOp::Negate, lowerNumber(*negated->operand, place), range);
  }
  if (const auto* operation = std::get_if<nc::Operation>(&expression.node))
    return ir::binary(operatorOf(operation->op), lowerNumber(*operation->left, place),
                      lowerNumber(*operation->right, place), range);
  if (const auto* call = std::get_if<nc::FunctionCall>(&expression.node))
    return function(*call, place, range);
  return ir::nullValue(range); // holes are of posts
}

ir::ExpressionPtr lowerNumber(const Expression& expression, Place place) {
  return orZero(lowerValue(expression, place));
}

ir::ExpressionPtr lowerWordValue(const Expression& expression, Place place) {
  const auto* negated = std::get_if<nc::Negated>(&expression.node);
  if (negated == nullptr || expression.brackets > 0 ||
      !std::holds_alternative<nc::VariableRef>(negated->operand->node) || negated->operand->brackets > 0) {
    ir::ExpressionPtr value = lowerValue(expression, place);
    // X[10] is computed: it is 10 mm, however the control reads X10.
    const double* const number = expression.brackets > 0 ? ir::constantValue(value) : nullptr;
    return number == nullptr ? value : ir::constant(*number, expression.range);
  }
  return ir::unary(UnaryOp::Negate, lowerValue(*negated->operand, place), expression.range);
}

ir::ConditionPtr lowerCondition(const Condition& condition) {
  const SourceRange range = condition.range;
  if (const auto* comparison = std::get_if<Comparison>(&condition.node)) {
    const bool same = comparison->op == "EQ";
    if (same || comparison->op == "NE")
      return ir::compare(same ? ir::Relation::Same : ir::Relation::Different,
                         lowerValue(*comparison->left, Place::Statement),
                         lowerValue(*comparison->right, Place::Statement), range);
    const ir::Relation relation = comparison->op == "GT"   ? ir::Relation::Greater
                                  : comparison->op == "GE" ? ir::Relation::GreaterEqual
                                  : comparison->op == "LT" ? ir::Relation::Less
                                                           : ir::Relation::LessEqual;
    return ir::compare(relation, lowerNumber(*comparison->left, Place::Statement),
                       lowerNumber(*comparison->right, Place::Statement), range);
  }
  const auto& joined = std::get<JoinedConditions>(condition.node);
  ir::ConditionPtr left = lowerCondition(*joined.left);
  ir::ConditionPtr right = lowerCondition(*joined.right);
  if (joined.op == "XOR")
    return ir::join(ir::Connective::Or, ir::join(ir::Connective::And, left, ir::negate(right), range),
                    ir::join(ir::Connective::And, ir::negate(left), right, range), range);
  return ir::join(joined.op == "AND" ? ir::Connective::And : ir::Connective::Or, left, right, range);
}

} // namespace dotek::frontend::macrob
