// Expressions and conditions in JavaScript. Arithmetic without a result gives NaN there; guards tell before.
#include "backends/fusion/State.h"
#include "support/messages/Fusion.h"

#include <algorithm>

namespace dotek::backends::fusion {

namespace {

class Printer {
public:
  Printer(State& state, SourceRange range) : state_(state), range_(range) {}

  std::string print(const ir::ExpressionPtr& value, bool operand) {
    const SourceRange outer = range_;
    if (value->range.hasPlace()) range_ = value->range;
    const std::string text = node(*value, operand);
    range_ = outer;
    return text;
  }

private:
  std::string node(const ir::Expression& value, bool operand) {
    return match(
        value, [&](const ir::Constant& node) { return std::string(numberLiteral(node.value, operand)); },
        [&](const ir::VariableUse& node) { return std::string(state_.name(node.variable)); },
        [](const ir::NullValue&) { return std::string("undefined"); },
        [&](const ir::Unary& node) { return unary(node, operand); },
        [&](const ir::Binary& node) { return binary(node, operand); },
        [&](const ir::OneOf<ir::MachineVariable, ir::MeasuredResult> auto&) {
          state_.refuse<diag::FusionRunTime>(range_);
          return std::string("0");
        });
  }

  std::string call(Helper helper, const ir::ExpressionPtr& operand) {
    return state_.helper(helper) + "(" + print(operand, false) + ")";
  }
  std::string call(Helper helper, const ir::Binary& op) {
    return state_.helper(helper) + "(" + print(op.left, false) + ", " + print(op.right, false) + ")";
  }
  std::string bits(std::string_view name, const ir::Binary& op) {
    return state_.helper(Helper::Bits) + "(\"" + std::string(name) + "\", " + print(op.left, false) + ", " +
           print(op.right, false) + ")";
  }
  std::string infix(const ir::Binary& op, std::string_view sign, bool operand) {
    const std::string text = print(op.left, true) + " " + std::string(sign) + " " + print(op.right, true);
    return operand ? "(" + text + ")" : text;
  }
  std::string orElse(const ir::ExpressionPtr& value, const std::string& other) {
    const std::string text = print(value, true);
    return "(" + text + " === undefined ? " + other + " : " + text + ")";
  }

  std::string unary(const ir::Unary& op, bool operand) {
    switch (op.op) {
    case ir::UnaryOp::Negate: {
      const std::string text = "-" + print(op.operand, true);
      return operand || text.starts_with("--") ? "(" + text + ")" : text;
    }
    case ir::UnaryOp::Absolute: return "Math.abs(" + print(op.operand, false) + ")";
    case ir::UnaryOp::Exponential: return "Math.exp(" + print(op.operand, false) + ")";
    case ir::UnaryOp::Truncate: return call(Helper::Truncate, op.operand);
    case ir::UnaryOp::RoundUp: return call(Helper::RoundUp, op.operand);
    case ir::UnaryOp::Round: return call(Helper::Round, op.operand);
    case ir::UnaryOp::SquareRoot: return call(Helper::SquareRoot, op.operand);
    case ir::UnaryOp::Sine: return call(Helper::Sine, op.operand);
    case ir::UnaryOp::Cosine: return call(Helper::Cosine, op.operand);
    case ir::UnaryOp::Tangent: return call(Helper::Tangent, op.operand);
    case ir::UnaryOp::ArcSine: return call(Helper::ArcSine, op.operand);
    case ir::UnaryOp::ArcCosine: return call(Helper::ArcCosine, op.operand);
    case ir::UnaryOp::ArcTangent: return call(Helper::ArcTangent, op.operand);
    case ir::UnaryOp::Logarithm: return call(Helper::Logarithm, op.operand);
    case ir::UnaryOp::NullAsZero: return orElse(op.operand, "0");
    case ir::UnaryOp::RoundIncrement:
    case ir::UnaryOp::FromBcd:
    case ir::UnaryOp::ToBcd:
    case ir::UnaryOp::AddPoint: break;
    }
    state_.refuse<diag::FusionRunTime>(range_);
    return "0";
  }

  std::string binary(const ir::Binary& op, bool operand) {
    switch (op.op) {
    case ir::BinaryOp::Add: return infix(op, "+", operand);
    case ir::BinaryOp::Subtract: return infix(op, "-", operand);
    case ir::BinaryOp::Multiply: return infix(op, "*", operand);
    case ir::BinaryOp::Divide: {
      const double* divisor = ir::constantValue(op.right);
      return divisor != nullptr && *divisor != 0 ? infix(op, "/", operand) : call(Helper::Divide, op);
    }
    case ir::BinaryOp::Modulo: return call(Helper::Modulo, op);
    case ir::BinaryOp::Direction: return call(Helper::Direction, op);
    case ir::BinaryOp::BitAnd: return bits("and", op);
    case ir::BinaryOp::BitOr: return bits("or", op);
    case ir::BinaryOp::BitXor: return bits("xor", op);
    case ir::BinaryOp::ValueOr: return orElse(op.left, print(op.right, true));
    case ir::BinaryOp::RoundedAnd:
    case ir::BinaryOp::RoundedOr:
    case ir::BinaryOp::RoundedXor:
    case ir::BinaryOp::RoundedModulo:
    case ir::BinaryOp::Power:
    case ir::BinaryOp::Bearing: break;
    }
    state_.refuse<diag::FusionRunTime>(range_);
    return "0";
  }

  State& state_;
  SourceRange range_;
};

std::string_view relationText(ir::Relation relation) {
  switch (relation) {
  case ir::Relation::Equal:
  case ir::Relation::Same: return "===";
  case ir::Relation::NotEqual:
  case ir::Relation::Different: return "!==";
  case ir::Relation::Less: return "<";
  case ir::Relation::Greater: return ">";
  case ir::Relation::LessEqual: return "<=";
  case ir::Relation::GreaterEqual: return ">=";
  }
  return "===";
}

// Whether the operator itself may have no result, whatever its operands are.
bool isPartial(ir::UnaryOp op) {
  switch (op) {
  case ir::UnaryOp::SquareRoot:
  case ir::UnaryOp::Tangent:
  case ir::UnaryOp::ArcSine:
  case ir::UnaryOp::ArcCosine:
  case ir::UnaryOp::Logarithm:
  case ir::UnaryOp::Exponential: return true;
  case ir::UnaryOp::Negate:
  case ir::UnaryOp::Absolute:
  case ir::UnaryOp::Truncate:
  case ir::UnaryOp::RoundUp:
  case ir::UnaryOp::Round:
  case ir::UnaryOp::Sine:
  case ir::UnaryOp::Cosine:
  case ir::UnaryOp::ArcTangent:
  case ir::UnaryOp::NullAsZero:
  case ir::UnaryOp::RoundIncrement: // refused, as the next three
  case ir::UnaryOp::FromBcd:
  case ir::UnaryOp::ToBcd:
  case ir::UnaryOp::AddPoint: break;
  }
  return false;
}

bool isPartial(const ir::Binary& node) {
  switch (node.op) {
  case ir::BinaryOp::Divide:
  case ir::BinaryOp::Modulo: {
    const double* divisor = ir::constantValue(node.right);
    return divisor == nullptr || *divisor == 0;
  }
  case ir::BinaryOp::Direction:
  case ir::BinaryOp::BitAnd:
  case ir::BinaryOp::BitOr:
  case ir::BinaryOp::BitXor: return true;
  case ir::BinaryOp::Add:
  case ir::BinaryOp::Subtract:
  case ir::BinaryOp::Multiply:
  case ir::BinaryOp::ValueOr:
  case ir::BinaryOp::RoundedAnd: // refused, as the next five
  case ir::BinaryOp::RoundedOr:
  case ir::BinaryOp::RoundedXor:
  case ir::BinaryOp::RoundedModulo:
  case ir::BinaryOp::Power:
  case ir::BinaryOp::Bearing: break;
  }
  return false;
}

// Operands first: a result that is not finite is seen before something hides it (1/(1/0) is 0).
void collectPartial(const ir::ExpressionPtr& value, std::vector<ir::ExpressionPtr>& out) {
  match(
      *value,
      [&](const ir::Unary& node) {
        collectPartial(node.operand, out);
        if (isPartial(node.op)) out.push_back(value);
      },
      [&](const ir::Binary& node) {
        collectPartial(node.left, out);
        collectPartial(node.right, out);
        if (isPartial(node)) out.push_back(value);
      },
      [](const ir::OneOf<ir::Constant, ir::NullValue, ir::VariableUse, ir::MachineVariable,
                         ir::MeasuredResult> auto&) {});
}

void collectPartial(const ir::ConditionPtr& condition, std::vector<ir::ExpressionPtr>& out) {
  if (const auto* comparison = std::get_if<ir::Comparison>(&condition->node)) {
    collectPartial(comparison->left, out);
    collectPartial(comparison->right, out);
  } else if (const auto* inner = std::get_if<ir::Not>(&condition->node)) {
    collectPartial(inner->inner, out);
  } else if (const auto* junction = std::get_if<ir::Junction>(&condition->node)) {
    collectPartial(junction->left, out);
    collectPartial(junction->right, out);
  }
}

void writeGuards(State& state, const std::vector<ir::ExpressionPtr>& partial, const ir::Origin& origin) {
  std::set<std::string> told;
  for (const ir::ExpressionPtr& value : partial) {
    const std::string text = valueText(state, value, origin.range());
    if (told.insert(text).second)
      state.errorIf("!isFinite(" + text + ")", "a formula has no result for these values", origin);
  }
}

} // namespace

std::string valueText(State& state, const ir::ExpressionPtr& value, SourceRange range, bool operand) {
  return Printer(state, range).print(value, operand);
}

std::string conditionText(State& state, const ir::ConditionPtr& condition, SourceRange range) {
  if (condition->range.hasPlace()) range = condition->range;
  if (const auto* comparison = std::get_if<ir::Comparison>(&condition->node))
    return valueText(state, comparison->left, range, true) + " " +
           std::string(relationText(comparison->relation)) + " " +
           valueText(state, comparison->right, range, true);
  if (const auto* null = std::get_if<ir::IsNull>(&condition->node))
    return valueText(state, null->value, range, true) + " === undefined";
  if (const auto* inner = std::get_if<ir::Not>(&condition->node))
    return "!(" + conditionText(state, inner->inner, range) + ")";
  if (const auto* junction = std::get_if<ir::Junction>(&condition->node))
    return "(" + conditionText(state, junction->left, range) +
           (junction->op == ir::Connective::And ? ") && (" : ") || (") +
           conditionText(state, junction->right, range) + ")";
  return std::get<ir::Truth>(condition->node).value ? "true" : "false";
}

void guardArithmetic(State& state, const ir::ExpressionPtr& value, const ir::Origin& origin) {
  std::vector<ir::ExpressionPtr> partial;
  collectPartial(value, partial);
  writeGuards(state, partial, origin);
}

void guardArithmetic(State& state, const ir::ConditionPtr& condition, const ir::Origin& origin) {
  std::vector<ir::ExpressionPtr> partial;
  collectPartial(condition, partial);
  // A side that is known decides AND and OR, whatever the other one is: no guard before says that.
  if (!partial.empty() && std::holds_alternative<ir::Junction>(condition->node)) {
    state.refuse<diag::FusionArithmetic>(condition->range.hasPlace() ? condition->range : origin.range());
    return;
  }
  writeGuards(state, partial, origin);
}

} // namespace dotek::backends::fusion
