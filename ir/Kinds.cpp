#include "ir/Kinds.h"

namespace dotek::ir {

bool keepsKind(UnaryOp op) {
  switch (op) {
  case UnaryOp::Negate:
  case UnaryOp::Absolute:
  case UnaryOp::Truncate:
  case UnaryOp::RoundUp:
  case UnaryOp::Round:
  case UnaryOp::NullAsZero: return true;
  default: return false;
  }
}

Kind operandKind(UnaryOp op) {
  switch (op) {
  case UnaryOp::Sine:
  case UnaryOp::Cosine:
  case UnaryOp::Tangent: return Kind::Angle;
  default: return Kind::Number;
  }
}

Kind resultKind(UnaryOp op) {
  switch (op) {
  case UnaryOp::ArcSine:
  case UnaryOp::ArcCosine:
  case UnaryOp::ArcTangent: return Kind::Angle;
  default: return Kind::Number;
  }
}

bool addsKinds(BinaryOp op) {
  switch (op) {
  case BinaryOp::Add:
  case BinaryOp::Subtract:
  case BinaryOp::Modulo:
  case BinaryOp::ValueOr: return true;
  default: return false;
  }
}

void eachRequirement(const CycleStatement& statement,
                     const std::function<void(const ExpressionPtr&, Kind)>& visit) {
  const auto require = [&](const ExpressionPtr& value, Kind kind) {
    if (value) visit(value, kind);
  };
  const auto coordinate = [&](const std::optional<Coordinate>& place) {
    if (!place) return;
    require(place->value, Kind::Length);
    require(place->system, Kind::WorkOffset);
  };
  if (const auto* move = std::get_if<Move>(&statement.node)) {
    for (const auto& axis : move->axes)
      coordinate(axis);
    require(move->feed, Kind::Feed);
  } else if (const auto* measure = std::get_if<Measure>(&statement.node)) {
    coordinate(measure->target);
    require(measure->diameter, Kind::Length);
    if (!measure->setting) return;
    require(measure->setting->system, Kind::WorkOffset);
    for (const auto& nominal : measure->setting->nominal)
      require(nominal, Kind::Length);
  } else if (const auto* mode = std::get_if<SetMode>(&statement.node)) {
    require(mode->system, Kind::WorkOffset);
  }
}

namespace {

Kind productKind(BinaryOp op, Kind left, Kind right) {
  const auto scales = [](Kind kind) {
    return kind == Kind::Number || kind == Kind::Ratio || kind == Kind::Count;
  };
  if (scales(right)) return left;
  return op == BinaryOp::Multiply && scales(left) ? right : Kind::Number;
}

} // namespace

Kind kindOf(const ExpressionPtr& expression, const Cycle& cycle, const Mixed& mixed) {
  if (const auto* use = std::get_if<VariableUse>(&expression->node))
    return use->variable < cycle.variables.size() ? cycle.variables[use->variable].kind : Kind::Number;
  if (const auto* machine = std::get_if<MachineVariable>(&expression->node)) {
    kindOf(machine->number, cycle, mixed);
  } else if (const auto* one = std::get_if<Unary>(&expression->node)) {
    const Kind kind = kindOf(one->operand, cycle, mixed);
    if (keepsKind(one->op)) return kind;
    const Kind wanted = operandKind(one->op);
    if (wanted != Kind::Number && kind != Kind::Number && kind != wanted) mixed(*expression, wanted, kind);
    return resultKind(one->op);
  } else if (const auto* two = std::get_if<Binary>(&expression->node)) {
    const Kind left = kindOf(two->left, cycle, mixed);
    const Kind right = kindOf(two->right, cycle, mixed);
    if (two->op == BinaryOp::Multiply || two->op == BinaryOp::Divide)
      return productKind(two->op, left, right);
    const bool alike = addsKinds(two->op) || two->op == BinaryOp::Direction;
    if (alike && left != right && left != Kind::Number && right != Kind::Number)
      mixed(*expression, left, right);
    if (two->op == BinaryOp::Direction) return Kind::Angle;
    if (addsKinds(two->op)) return left == Kind::Number ? right : left;
  }
  return Kind::Number;
}

} // namespace dotek::ir
