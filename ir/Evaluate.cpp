#include "ir/Evaluate.h"

#include <unordered_map>
#include <utility>

namespace dotek::ir {
namespace {

using State = Scalar::State;

Scalar scalar(Computed computed) {
  return computed.ok() ? Scalar::of(computed.value) : Scalar::failed(computed.error);
}

// The operand of arithmetic: Null fails.
Scalar operand(const Scalar& value) {
  return value.state == State::Null ? Scalar::failed(ArithmeticError::NoValue) : value;
}

Scalar evaluateUnary(const Unary& node, const Environment& environment, const Readings* readings) {
  const Scalar value = evaluate(*node.operand, environment, readings);
  if (node.op == UnaryOp::NullAsZero && value.state == State::Null) return Scalar::of(0);
  const Scalar a = operand(value);
  return a.known() ? scalar(compute(node.op, a.value)) : a;
}

Scalar evaluateBinary(const Binary& node, const Environment& environment, const Readings* readings) {
  const Scalar left = evaluate(*node.left, environment, readings);
  if (node.op == BinaryOp::ValueOr)
    return left.state == State::Null ? evaluate(*node.right, environment, readings) : left;
  const Scalar a = operand(left);
  if (a.state == State::Failed) return a;
  const Scalar b = operand(evaluate(*node.right, environment, readings));
  if (b.state == State::Failed || !b.known()) return b;
  return a.known() ? scalar(compute(node.op, a.value, b.value)) : a;
}

bool compareNumbers(Relation relation, double a, double b) {
  switch (relation) {
  case Relation::Equal: return a == b;
  case Relation::NotEqual: return a != b;
  case Relation::Less: return a < b;
  case Relation::Greater: return a > b;
  case Relation::LessEqual: return a <= b;
  case Relation::GreaterEqual: return a >= b;
  case Relation::Same: return a == b;
  case Relation::Different: return a != b;
  }
  return false;
}

// Null is a value of its own.
Verdict decideSameness(const Comparison& node, const Environment& environment, const Readings* readings) {
  const Scalar a = evaluate(*node.left, environment, readings);
  const Scalar b = evaluate(*node.right, environment, readings);
  if (a.state == State::Failed || b.state == State::Failed) return Verdict::Failed;
  if (a.state == State::Unknown || b.state == State::Unknown) return Verdict::Unknown;
  const bool same = a.state == b.state && (a.state == State::Null || a.value == b.value);
  return same == (node.relation == Relation::Same) ? Verdict::True : Verdict::False;
}

Verdict decideComparison(const Comparison& node, const Environment& environment, const Readings* readings) {
  if (node.relation == Relation::Same || node.relation == Relation::Different)
    return decideSameness(node, environment, readings);
  const Scalar a = operand(evaluate(*node.left, environment, readings));
  const Scalar b = operand(evaluate(*node.right, environment, readings));
  if (a.state == State::Failed || b.state == State::Failed) return Verdict::Failed;
  if (!a.known() || !b.known()) return Verdict::Unknown;
  return compareNumbers(node.relation, a.value, b.value) ? Verdict::True : Verdict::False;
}

Verdict decideNull(const IsNull& node, const Environment& environment, const Readings* readings) {
  switch (evaluate(*node.value, environment, readings).state) {
  case State::Known: return Verdict::False;
  case State::Null: return Verdict::True;
  case State::Unknown: return Verdict::Unknown;
  case State::Failed: return Verdict::Failed;
  }
  return Verdict::Unknown;
}

Verdict decideJunction(const Junction& node, const Environment& environment, const Readings* readings) {
  const Verdict deciding = node.op == Connective::And ? Verdict::False : Verdict::True;
  const Verdict left = decide(*node.left, environment, readings);
  if (left == deciding) return left;
  const Verdict right = decide(*node.right, environment, readings);
  if (right == deciding) return right;
  for (const Verdict open : {Verdict::Unknown, Verdict::Failed})
    if (left == open || right == open) return open;
  return left;
}

} // namespace

Computed compute(UnaryOp op, double a) {
  constexpr auto kDegrees = AngleUnit::Degrees;
  switch (op) {
  case UnaryOp::Negate: return subtract(0, a);
  case UnaryOp::Absolute: return absolute(a);
  case UnaryOp::Truncate: return truncate(a);
  case UnaryOp::RoundUp: return roundUp(a);
  case UnaryOp::Round: return roundNearest(a);
  case UnaryOp::SquareRoot: return squareRoot(a);
  case UnaryOp::Sine: return sine(a, kDegrees);
  case UnaryOp::Cosine: return cosine(a, kDegrees);
  case UnaryOp::Tangent: return tangent(a, kDegrees);
  case UnaryOp::ArcSine: return arcSine(a, kDegrees);
  case UnaryOp::ArcCosine: return arcCosine(a, kDegrees);
  case UnaryOp::ArcTangent: return arcTangent(a, kDegrees);
  case UnaryOp::Logarithm: return logarithm(a);
  case UnaryOp::Exponential: return exponential(a);
  case UnaryOp::NullAsZero: return {a, ArithmeticError::None};
  case UnaryOp::FromBcd: return fromBcd(a);
  case UnaryOp::ToBcd: return toBcd(a);
  // What these give depends on the control.
  case UnaryOp::RoundIncrement:
  case UnaryOp::AddPoint: break;
  }
  return {0, ArithmeticError::Domain};
}

Computed compute(BinaryOp op, double a, double b) {
  switch (op) {
  case BinaryOp::Add: return add(a, b);
  case BinaryOp::Subtract: return subtract(a, b);
  case BinaryOp::Multiply: return multiply(a, b);
  case BinaryOp::Divide: return divide(a, b);
  case BinaryOp::Modulo: return modulo(a, b);
  case BinaryOp::Direction: return direction(a, b, AngleUnit::Degrees);
  case BinaryOp::BitAnd: return bitAnd(a, b);
  case BinaryOp::BitOr: return bitOr(a, b);
  case BinaryOp::BitXor: return bitXor(a, b);
  case BinaryOp::ValueOr: return {a, ArithmeticError::None};
  case BinaryOp::RoundedAnd: return roundedAnd(a, b);
  case BinaryOp::RoundedOr: return roundedOr(a, b);
  case BinaryOp::RoundedXor: return roundedXor(a, b);
  case BinaryOp::RoundedModulo: return roundedModulo(a, b);
  case BinaryOp::Power: return power(a, b);
  case BinaryOp::Bearing: return bearing(a, b);
  }
  return {0, ArithmeticError::Domain};
}

Scalar evaluate(const Expression& expression, const Environment& environment, const Readings* readings) {
  return match(
      expression, [](const Constant& node) { return Scalar::of(node.value); },
      [](const NullValue&) { return Scalar::null(); },
      [&](const VariableUse& node) {
        return node.variable < environment.size() ? environment[node.variable] : Scalar{};
      },
      [&](const Unary& node) { return evaluateUnary(node, environment, readings); },
      [&](const Binary& node) { return evaluateBinary(node, environment, readings); },
      [&](const MachineVariable& node) {
        if (readings == nullptr) return Scalar{};
        const Scalar number = operand(evaluate(*node.number, environment, readings));
        return number.known() ? readings->machineVariable(number.value) : number;
      },
      [&](const MeasuredResult& node) {
        return readings == nullptr ? Scalar{} : readings->result(node.name);
      });
}

Verdict decide(const Condition& condition, const Environment& environment, const Readings* readings) {
  return match(
      condition, [&](const Comparison& node) { return decideComparison(node, environment, readings); },
      [&](const IsNull& node) { return decideNull(node, environment, readings); },
      [&](const Junction& node) { return decideJunction(node, environment, readings); },
      [&](const Not& node) {
        const Verdict inner = decide(*node.inner, environment, readings);
        if (inner == Verdict::True) return Verdict::False;
        return inner == Verdict::False ? Verdict::True : inner;
      },
      [](const Truth& node) { return node.value ? Verdict::True : Verdict::False; });
}

std::optional<bool> holds(const Condition& condition, const Environment& environment) {
  const Verdict verdict = decide(condition, environment);
  if (verdict == Verdict::Unknown || verdict == Verdict::Failed) return std::nullopt;
  return verdict == Verdict::True;
}

CheckRun runChecks(const Cycle& cycle, Environment environment, std::uint32_t maxSteps) {
  using End = CheckRun::End;
  const std::vector<CycleStatement>& list = cycle.checks;
  std::unordered_map<LabelId, std::size_t> places;
  for (std::size_t i = 0; i < list.size(); ++i)
    if (const auto* label = std::get_if<Label>(&list[i].node)) places.try_emplace(label->label, i);
  if (environment.size() < cycle.variables.size()) environment.resize(cycle.variables.size());

  std::size_t at = 0;
  for (std::uint32_t steps = 0; at < list.size(); ++steps) {
    const CycleStatement& statement = list[at];
    if (steps >= maxSteps) return {End::Endless, &statement};
    std::optional<LabelId> target;
    const std::optional<End> end = match(
        statement,
        [&](const Assign& node) -> std::optional<End> {
          const Scalar value = evaluate(*node.value, environment);
          if (value.state == State::Failed) return End::Failed;
          if (node.variable < environment.size()) environment[node.variable] = value;
          return std::nullopt;
        },
        [&](const Branch& node) -> std::optional<End> {
          const Verdict verdict = decide(*node.condition, environment);
          if (verdict == Verdict::Unknown) return End::Unknown;
          if (verdict == Verdict::Failed) return End::Failed;
          if (verdict == Verdict::True) target = node.target;
          return std::nullopt;
        },
        [&](const Jump& node) -> std::optional<End> {
          target = node.target;
          return std::nullopt;
        },
        [](const Alarm&) -> std::optional<End> { return End::Alarm; },
        [](const Return&) -> std::optional<End> { return End::Passes; },
        [](const OpaqueBlock&) -> std::optional<End> { return End::Unknown; },
        // What verify() refuses in checks, and what changes no variable of the cycle.
        [](const OneOf<Store, Label, Move, Measure, CallCycle, ProbePower, Spindle, Coolant, SetMode, Dwell,
                       Stop, Comment, Port, Print> auto&) -> std::optional<End> { return std::nullopt; });
    if (end) return {*end, *end == End::Passes ? nullptr : &statement};
    if (!target) {
      ++at;
      continue;
    }
    const auto place = places.find(*target);
    if (place == places.end()) return {End::Failed, &statement}; // verify() tells
    at = place->second;
  }
  return {};
}

} // namespace dotek::ir
