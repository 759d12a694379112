// Expressions and conditions as instructions.
#include "sim/machine/Compiler.h"
#include "sim/machine/Decimal8.h"

#include <cmath>

namespace dotek::sim {

std::optional<std::uint32_t> Compiler::literalNumber(const ir::ExpressionPtr& expression) const {
  const double* const number = ir::constantValue(expression);
  if (number == nullptr) return std::nullopt;
  const double whole = std::round(*number);
  // What is no number of a variable at all takes the number of none: the control says so where it is reached.
  return whole >= 0 && whole < 1e9 ? static_cast<std::uint32_t>(whole) : UINT32_MAX;
}

std::uint32_t Compiler::constant(double value) {
  if (control_.arithmetic == stdlib::Arithmetic::Decimal8) value = toDecimal8(value);
  const auto [at, added] = constants_.try_emplace(value, static_cast<std::uint32_t>(code_.constants.size()));
  if (added) code_.constants.push_back(value);
  return layout_.size() + kTemporaries + at->second;
}

std::uint32_t Compiler::temporary(std::uint32_t into) {
  if (into != kNoCell) return into;
  if (temporaries_ == kTemporaries) {
    refuse("the statement computes more values at once than Dotek keeps");
    return layout_.size();
  }
  return layout_.size() + temporaries_++;
}

std::uint32_t Compiler::operand(const ir::ExpressionPtr& expression) {
  if (const auto* unary = std::get_if<ir::Unary>(&expression->node);
      unary != nullptr && unary->op == ir::UnaryOp::NullAsZero)
    return operand(unary->operand);
  return value(expression);
}

std::uint32_t Compiler::value(const ir::ExpressionPtr& expression, std::uint32_t into) {
  return match(
      *expression, [&](const ir::Constant& node) { return constant(node.value); },
      [](const ir::NullValue&) { return std::uint32_t{0}; }, // the cell of #0
      [&](const ir::MachineVariable& node) { return read(node, into); },
      [&](const ir::Unary& node) { return unary(node, into); },
      [&](const ir::Binary& node) { return binary(node, into); },
      [&](const ir::OneOf<ir::VariableUse, ir::MeasuredResult> auto&) {
        refuse("a value of a cycle, which no control has");
        return std::uint32_t{0};
      });
}

std::uint32_t Compiler::read(const ir::MachineVariable& variable, std::uint32_t into) {
  if (const std::optional<std::uint32_t> number = literalNumber(variable.number)) {
    if (*number == 0) return 0;
    if (const std::uint32_t cell = layout_.cellOf(*number); cell != CellLayout::kNone) return cell;
    const std::uint32_t to = temporary(into);
    emit(Op::Read, *number, 0, to, kHazard);
    return to;
  }
  const std::uint32_t at = operand(variable.number);
  const std::uint32_t to = temporary(into);
  emit(Op::ReadAt, at, 0, to);
  return to;
}

std::uint32_t Compiler::unary(const ir::Unary& unary, std::uint32_t into) {
  using ir::UnaryOp;
  const bool bare = std::holds_alternative<ir::MachineVariable>(unary.operand->node);
  const std::uint32_t a = operand(unary.operand);
  const std::uint32_t to = temporary(into);
  switch (unary.op) {
  case UnaryOp::NullAsZero: emit(Op::Number, a, 0, to); break;
  case UnaryOp::Negate:
    if (bare)
      emit(Op::NegateGiven, a, 0, to);
    else
      emit(Op::Unary, a, 0, to, static_cast<std::uint8_t>(unary.op));
    break;
  case UnaryOp::Sine: emit(Op::Sine, a, 0, to); break;
  case UnaryOp::Cosine: emit(Op::Cosine, a, 0, to); break;
  case UnaryOp::SquareRoot: emit(Op::SquareRoot, a, 0, to); break;
  case UnaryOp::RoundIncrement: emit(Op::ToIncrement, a, 0, to, static_cast<std::uint8_t>(letter_)); break;
  case UnaryOp::AddPoint: refuse("what ADP adds depends on a parameter of the machine"); break;
  case UnaryOp::Absolute:
  case UnaryOp::Truncate:
  case UnaryOp::RoundUp:
  case UnaryOp::Round:
  case UnaryOp::Tangent:
  case UnaryOp::ArcSine:
  case UnaryOp::ArcCosine:
  case UnaryOp::ArcTangent:
  case UnaryOp::Logarithm:
  case UnaryOp::Exponential:
  case UnaryOp::FromBcd:
  case UnaryOp::ToBcd: emit(Op::Unary, a, 0, to, static_cast<std::uint8_t>(unary.op)); break;
  }
  return to;
}

std::uint32_t Compiler::binary(const ir::Binary& binary, std::uint32_t into) {
  using ir::BinaryOp;
  if (binary.op == BinaryOp::ValueOr) {
    refuse("a default of a cycle, which no control has");
    return 0;
  }
  const std::uint32_t a = operand(binary.left);
  const std::uint32_t b = operand(binary.right);
  const std::uint32_t to = temporary(into);
  switch (binary.op) {
  case BinaryOp::Add: emit(Op::Add, a, b, to); break;
  case BinaryOp::Subtract: emit(Op::Subtract, a, b, to); break;
  case BinaryOp::Multiply: emit(Op::Multiply, a, b, to); break;
  case BinaryOp::Divide: emit(Op::Divide, a, b, to); break;
  case BinaryOp::ValueOr: // refused above
  case BinaryOp::Modulo:
  case BinaryOp::Direction:
  case BinaryOp::BitAnd:
  case BinaryOp::BitOr:
  case BinaryOp::BitXor:
  case BinaryOp::RoundedAnd:
  case BinaryOp::RoundedOr:
  case BinaryOp::RoundedXor:
  case BinaryOp::RoundedModulo:
  case BinaryOp::Power:
  case BinaryOp::Bearing: emit(Op::Binary, a, b, to, static_cast<std::uint8_t>(binary.op)); break;
  }
  return to;
}

std::optional<std::uint32_t> Compiler::jumpIf(const ir::ConditionPtr& condition, bool holds) {
  if (const auto* truth = std::get_if<ir::Truth>(&condition->node))
    return truth->value == holds ? std::optional(emit(Op::Jump)) : std::nullopt;
  if (const auto* inner = std::get_if<ir::Not>(&condition->node)) return jumpIf(inner->inner, !holds);
  if (const auto* comparison = std::get_if<ir::Comparison>(&condition->node)) {
    const ir::Relation relation = holds ? comparison->relation : ir::opposite(comparison->relation);
    Op op = Op::JumpSame;
    switch (relation) {
    case ir::Relation::Less: op = Op::JumpLess; break;
    case ir::Relation::Greater: op = Op::JumpGreater; break;
    case ir::Relation::LessEqual: op = Op::JumpLessEqual; break;
    case ir::Relation::GreaterEqual: op = Op::JumpGreaterEqual; break;
    case ir::Relation::Same: op = Op::JumpSame; break;
    case ir::Relation::Different: op = Op::JumpDifferent; break;
    case ir::Relation::Equal:
    case ir::Relation::NotEqual: { // null as 0
      const std::uint32_t a = truth(condition);
      return emit(holds ? Op::JumpTrue : Op::JumpFalse, a);
    }
    }
    const bool null = relation == ir::Relation::Same || relation == ir::Relation::Different;
    const std::uint32_t a = null ? value(comparison->left) : operand(comparison->left);
    const std::uint32_t b = null ? value(comparison->right) : operand(comparison->right);
    return emit(op, a, b);
  }
  const std::uint32_t cell = truth(condition);
  return emit(holds ? Op::JumpTrue : Op::JumpFalse, cell);
}

std::uint32_t Compiler::truth(const ir::ConditionPtr& condition) {
  if (const auto* truth = std::get_if<ir::Truth>(&condition->node)) return constant(truth->value ? 1 : 0);
  if (const auto* comparison = std::get_if<ir::Comparison>(&condition->node)) {
    const bool null =
        comparison->relation == ir::Relation::Same || comparison->relation == ir::Relation::Different;
    const std::uint32_t a = null ? value(comparison->left) : operand(comparison->left);
    const std::uint32_t b = null ? value(comparison->right) : operand(comparison->right);
    const std::uint32_t to = temporary();
    emit(Op::Test, a, b, to, static_cast<std::uint8_t>(comparison->relation));
    return to;
  }
  if (const auto* null = std::get_if<ir::IsNull>(&condition->node)) {
    const std::uint32_t a = value(null->value);
    const std::uint32_t to = temporary();
    emit(Op::Test, a, 0, to, kIsNull);
    return to;
  }
  if (const auto* inner = std::get_if<ir::Not>(&condition->node)) {
    const std::uint32_t a = truth(inner->inner);
    const std::uint32_t to = temporary();
    emit(Op::Not, a, 0, to);
    return to;
  }
  // A control computes both sides, whatever the first gives.
  const auto& junction = std::get<ir::Junction>(condition->node);
  const std::uint32_t a = truth(junction.left);
  const std::uint32_t b = truth(junction.right);
  const std::uint32_t to = temporary();
  emit(junction.op == ir::Connective::And ? Op::And : Op::Or, a, b, to);
  return to;
}

} // namespace dotek::sim
