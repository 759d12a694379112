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
  case UnaryOp::SquareRoot:
  case UnaryOp::Sine:
  case UnaryOp::Cosine:
  case UnaryOp::Tangent:
  case UnaryOp::ArcSine:
  case UnaryOp::ArcCosine:
  case UnaryOp::ArcTangent:
  case UnaryOp::Logarithm:
  case UnaryOp::Exponential:
  case UnaryOp::RoundIncrement:
  case UnaryOp::FromBcd:
  case UnaryOp::ToBcd:
  case UnaryOp::AddPoint: break;
  }
  return false;
}

Kind operandKind(UnaryOp op) {
  switch (op) {
  case UnaryOp::Sine:
  case UnaryOp::Cosine:
  case UnaryOp::Tangent: return Kind::Angle;
  case UnaryOp::Negate:
  case UnaryOp::Absolute:
  case UnaryOp::Truncate:
  case UnaryOp::RoundUp:
  case UnaryOp::Round:
  case UnaryOp::SquareRoot:
  case UnaryOp::ArcSine:
  case UnaryOp::ArcCosine:
  case UnaryOp::ArcTangent:
  case UnaryOp::Logarithm:
  case UnaryOp::Exponential:
  case UnaryOp::NullAsZero:
  case UnaryOp::RoundIncrement:
  case UnaryOp::FromBcd:
  case UnaryOp::ToBcd:
  case UnaryOp::AddPoint: break;
  }
  return Kind::Number;
}

Kind resultKind(ResultName name) {
  switch (name) {
  case ResultName::Angle:
  case ResultName::AngleY:
  case ResultName::AngleError:
  case ResultName::AngleErrorY: return Kind::Angle;
  case ResultName::PositionX:
  case ResultName::PositionY:
  case ResultName::PositionZ:
  case ResultName::Size:
  case ResultName::ErrorX:
  case ResultName::ErrorY:
  case ResultName::ErrorZ:
  case ResultName::SizeError:
  case ResultName::TruePosition:
  case ResultName::MetalCondition:
  case ResultName::Maximum:
  case ResultName::Variation: return Kind::Length;
  case ResultName::Main:
  case ResultName::TouchDirection:
  case ResultName::Hole:
  case ResultName::OutOfTolerance:
  case ResultName::ProbeError: break;
  }
  return Kind::Number;
}

Kind resultKind(UnaryOp op) {
  switch (op) {
  case UnaryOp::ArcSine:
  case UnaryOp::ArcCosine:
  case UnaryOp::ArcTangent: return Kind::Angle;
  case UnaryOp::Negate:
  case UnaryOp::Absolute:
  case UnaryOp::Truncate:
  case UnaryOp::RoundUp:
  case UnaryOp::Round:
  case UnaryOp::SquareRoot:
  case UnaryOp::Sine:
  case UnaryOp::Cosine:
  case UnaryOp::Tangent:
  case UnaryOp::Logarithm:
  case UnaryOp::Exponential:
  case UnaryOp::NullAsZero:
  case UnaryOp::RoundIncrement:
  case UnaryOp::FromBcd:
  case UnaryOp::ToBcd:
  case UnaryOp::AddPoint: break;
  }
  return Kind::Number;
}

bool addsKinds(BinaryOp op) {
  switch (op) {
  case BinaryOp::Add:
  case BinaryOp::Subtract:
  case BinaryOp::Modulo:
  case BinaryOp::ValueOr: return true;
  case BinaryOp::Multiply:
  case BinaryOp::Divide:
  case BinaryOp::Direction:
  case BinaryOp::BitAnd:
  case BinaryOp::BitOr:
  case BinaryOp::BitXor:
  case BinaryOp::RoundedAnd:
  case BinaryOp::RoundedOr:
  case BinaryOp::RoundedXor:
  case BinaryOp::RoundedModulo:
  case BinaryOp::Power:
  case BinaryOp::Bearing: break;
  }
  return false;
}

bool isShiftedCount(const Binary& sum) {
  constexpr double kFirstBeyond = 100;
  if (sum.op != BinaryOp::Add) return false;
  const double* shift = constantValue(sum.right);
  if (shift == nullptr) shift = constantValue(sum.left);
  return shift != nullptr && *shift >= kFirstBeyond;
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
  match(
      statement,
      [&](const Move& node) {
        for (const auto& axis : node.axes)
          coordinate(axis);
        require(node.feed, Kind::Feed);
      },
      [&](const Measure& node) {
        coordinate(node.target);
        require(node.diameter, Kind::Length);
        if (!node.setting) return;
        require(node.setting->system, Kind::WorkOffset);
        for (const auto& nominal : node.setting->nominal)
          require(nominal, Kind::Length);
      },
      [&](const CallCycle& node) {
        for (const CycleArgument& argument : node.arguments)
          if (argument.kind == Kind::Length || argument.kind == Kind::Angle || argument.kind == Kind::Feed)
            require(argument.value, argument.kind);
        if (!node.setting) return;
        require(node.setting->system, Kind::WorkOffset);
        for (const auto& nominal : node.setting->nominal)
          require(nominal, Kind::Length);
      },
      [&](const SetMode& node) { require(node.system, Kind::WorkOffset); },
      [](const OneOf<Assign, Store, Label, Jump, Branch, Return, ProbePower, Spindle, Coolant, Dwell, Stop,
                     Alarm, Comment, OpaqueBlock, Port, Print> auto&) {});
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
  return match(
      *expression,
      [&](const VariableUse& node) {
        return node.variable < cycle.variables.size() ? cycle.variables[node.variable].kind : Kind::Number;
      },
      [&](const MachineVariable& node) {
        kindOf(node.number, cycle, mixed);
        return Kind::Number;
      },
      [&](const Unary& node) {
        const Kind kind = kindOf(node.operand, cycle, mixed);
        if (keepsKind(node.op)) return kind;
        const Kind wanted = operandKind(node.op);
        if (wanted != Kind::Number && kind != Kind::Number && kind != wanted)
          mixed(*expression, wanted, kind);
        return resultKind(node.op);
      },
      [&](const Binary& node) {
        const Kind left = kindOf(node.left, cycle, mixed);
        const Kind right = kindOf(node.right, cycle, mixed);
        if (node.op == BinaryOp::Multiply || node.op == BinaryOp::Divide)
          return productKind(node.op, left, right);
        const bool alike = addsKinds(node.op) || node.op == BinaryOp::Direction;
        if (alike && left != right && left != Kind::Number && right != Kind::Number)
          mixed(*expression, left, right);
        if (node.op == BinaryOp::Direction) return Kind::Angle;
        if ((left == Kind::Count || right == Kind::Count) && isShiftedCount(node)) return Kind::Number;
        return !addsKinds(node.op) ? Kind::Number : left == Kind::Number ? right : left;
      },
      [](const OneOf<Constant, NullValue, MeasuredResult> auto&) { return Kind::Number; });
}

} // namespace dotek::ir
