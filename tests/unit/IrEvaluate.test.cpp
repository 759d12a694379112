// Values of expressions and conditions, and how checks end.
#include "tests/unit/IrHelper.h"

#include "ir/Evaluate.h"

#include <cmath>
#include <doctest/doctest.h>

using namespace dotek;
using namespace dotek::ir;
using namespace dotek::tests;

namespace {

constexpr VariableId kA = 0;
constexpr VariableId kB = 1;

Scalar value(const ExpressionPtr& expression, const Environment& environment = {}) {
  return evaluate(*expression, environment);
}

double number(const ExpressionPtr& expression) {
  const Scalar result = value(expression);
  REQUIRE(result.known());
  return result.value;
}

ArithmeticError failure(const ExpressionPtr& expression) {
  const Scalar result = value(expression);
  REQUIRE(result.state == Scalar::State::Failed);
  return result.error;
}

ExpressionPtr of(UnaryOp op, double a) {
  return unary(op, constant(a));
}

ExpressionPtr of(BinaryOp op, double a, double b) {
  return binary(op, constant(a), constant(b));
}

const ConditionPtr kYes = truth(true);
const ConditionPtr kNo = truth(false);

} // namespace

TEST_CASE("ir: every operator has its value") {
  CHECK(number(of(UnaryOp::Negate, 5)) == -5);
  CHECK_FALSE(std::signbit(number(of(UnaryOp::Negate, 0))));
  CHECK(number(of(UnaryOp::Absolute, -5)) == 5);
  CHECK(number(of(UnaryOp::Truncate, -1.7)) == -1);
  CHECK(number(of(UnaryOp::RoundUp, 1.2)) == 2);
  CHECK(number(of(UnaryOp::RoundUp, -1.2)) == -2);
  CHECK(number(of(UnaryOp::Round, 2.5)) == 3);
  CHECK(number(of(UnaryOp::Round, -2.5)) == -3);
  CHECK(number(of(UnaryOp::SquareRoot, 9)) == 3);
  CHECK(number(of(UnaryOp::Sine, 90)) == 1);
  CHECK(number(of(UnaryOp::Cosine, 180)) == -1);
  CHECK(number(of(UnaryOp::Tangent, 45)) == doctest::Approx(1));
  CHECK(number(of(UnaryOp::ArcSine, 1)) == doctest::Approx(90));
  CHECK(number(of(UnaryOp::ArcCosine, -1)) == doctest::Approx(180));
  CHECK(number(of(UnaryOp::ArcTangent, -1)) == doctest::Approx(-45));
  CHECK(number(of(UnaryOp::Logarithm, 1)) == 0);
  CHECK(number(of(UnaryOp::Exponential, 0)) == 1);
  CHECK(number(of(BinaryOp::Add, 1, 2)) == 3);
  CHECK(number(of(BinaryOp::Subtract, 1, 2)) == -1);
  CHECK(number(of(BinaryOp::Multiply, 3, -2)) == -6);
  CHECK(number(of(BinaryOp::Divide, 1, 4)) == 0.25);
  CHECK(number(of(BinaryOp::Modulo, -7, 3)) == -1);
  CHECK(number(of(BinaryOp::Direction, 0, -2)) == doctest::Approx(-90));
  CHECK(number(of(BinaryOp::BitAnd, 6, 3)) == 2);
  CHECK(number(of(BinaryOp::BitOr, 6, 3)) == 7);
  CHECK(number(of(BinaryOp::BitXor, 6, -1)) == -7);
}

TEST_CASE("ir: what has no value says why") {
  CHECK(failure(of(BinaryOp::Divide, 1, 0)) == ArithmeticError::DivisionByZero);
  CHECK(failure(of(BinaryOp::Modulo, 1, 0)) == ArithmeticError::DivisionByZero);
  CHECK(failure(of(BinaryOp::Direction, 0, 0)) == ArithmeticError::Domain);
  CHECK(failure(of(UnaryOp::SquareRoot, -1)) == ArithmeticError::Domain);
  CHECK(failure(of(UnaryOp::Logarithm, 0)) == ArithmeticError::Domain);
  CHECK(failure(of(UnaryOp::Tangent, 90)) == ArithmeticError::Domain);
  CHECK(failure(of(UnaryOp::Exponential, 1000)) == ArithmeticError::Overflow);
  CHECK(failure(of(BinaryOp::BitAnd, 0.5, 1)) == ArithmeticError::Domain);
  CHECK(failure(of(BinaryOp::BitOr, 4294967296.0, 1)) == ArithmeticError::Domain);
  // A failure inside stays one, whatever is unknown beside it.
  const auto failing = of(BinaryOp::Divide, 1, 0);
  CHECK(failure(binary(BinaryOp::Add, failing, variable(kA))) == ArithmeticError::DivisionByZero);
  CHECK(failure(binary(BinaryOp::Add, variable(kA), failing)) == ArithmeticError::DivisionByZero);
}

TEST_CASE("ir: null is no zero") {
  const Environment nothing = {Scalar::null(), Scalar::of(4)};
  CHECK(value(variable(kA), nothing).state == Scalar::State::Null);
  CHECK(value(nullValue()).state == Scalar::State::Null);
  const auto sum = binary(BinaryOp::Add, variable(kA), constant(1));
  CHECK(value(sum, nothing).error == ArithmeticError::NoValue);
  CHECK(value(unary(UnaryOp::Negate, variable(kA)), nothing).error == ArithmeticError::NoValue);
  CHECK(value(unary(UnaryOp::NullAsZero, variable(kA)), nothing).value == 0);
  CHECK(value(unary(UnaryOp::NullAsZero, variable(kA)), nothing).known());
  CHECK(value(unary(UnaryOp::NullAsZero, variable(kB)), nothing).value == 4);
  CHECK(value(binary(BinaryOp::ValueOr, variable(kA), variable(kB)), nothing).value == 4);
  CHECK(value(binary(BinaryOp::ValueOr, variable(kB), constant(7)), nothing).value == 4);
  CHECK(value(binary(BinaryOp::ValueOr, nullValue(), nullValue())).state == Scalar::State::Null);
  CHECK(holds(*isNull(variable(kA)), nothing) == true);
  CHECK(holds(*isNull(variable(kB)), nothing) == false);
  CHECK(holds(*isNull(variable(2)), nothing) == std::nullopt);
  CHECK(holds(*compare(Relation::Equal, variable(kA), constant(0)), nothing) == std::nullopt);
}

TEST_CASE("ir: what only the machine knows is unknown") {
  CHECK(value(machineVariable(constant(550))).state == Scalar::State::Unknown);
  CHECK(value(result(ResultName::Main)).state == Scalar::State::Unknown);
  CHECK(value(variable(kA)).state == Scalar::State::Unknown);
}

TEST_CASE("ir: a known side decides and and or") {
  const auto open = compare(Relation::Less, variable(kA), constant(1));
  const auto failing = compare(Relation::Less, of(BinaryOp::Divide, 1, 0), constant(1));
  for (const auto& other : {open, failing}) {
    for (const bool first : {true, false}) {
      const auto pair = [&](Connective op, const ConditionPtr& known) {
        return holds(*(first ? join(op, known, other) : join(op, other, known)), {});
      };
      CHECK(pair(Connective::And, kNo) == false);
      CHECK(pair(Connective::And, kYes) == std::nullopt);
      CHECK(pair(Connective::Or, kYes) == true);
      CHECK(pair(Connective::Or, kNo) == std::nullopt);
    }
  }
  CHECK(holds(*join(Connective::And, kYes, kYes), {}) == true);
  CHECK(holds(*join(Connective::Or, kNo, kNo), {}) == false);
}

TEST_CASE("ir: relations") {
  const auto related = [](Relation relation, double a, double b) {
    return holds(*compare(relation, constant(a), constant(b)), {}).value();
  };
  CHECK(related(Relation::Equal, 1, 1));
  CHECK_FALSE(related(Relation::Equal, 1, 2));
  CHECK(related(Relation::NotEqual, 1, 2));
  CHECK(related(Relation::Less, 1, 2));
  CHECK_FALSE(related(Relation::Less, 1, 1));
  CHECK(related(Relation::Greater, 2, 1));
  CHECK(related(Relation::LessEqual, 1, 1));
  CHECK(related(Relation::GreaterEqual, 1, 1));
  CHECK_FALSE(related(Relation::GreaterEqual, 0, 1));
}

TEST_CASE("ir: checks end where the arguments lead") {
  Cycle cycle;
  const VariableId g = cycle.add(parameter("G"));
  const LabelId wrong = cycle.addLabel({"wrong", {}});
  const LabelId loop = cycle.addLabel({"loop", {}});
  cycle.checks = {statement(Branch{compare(Relation::Less, variable(g), constant(54)), wrong}),
                  statement(Branch{compare(Relation::Equal, variable(g), constant(60)), loop}),
                  statement(Assign{g, binary(BinaryOp::Divide, constant(1),
                                             binary(BinaryOp::Subtract, variable(g), constant(59)))}),
                  statement(Return{}),
                  statement(Label{wrong}),
                  statement(Alarm{"system below 54"}),
                  statement(Label{loop}),
                  statement(Jump{loop})};
  using End = CheckRun::End;
  const auto run = [&](const Scalar& value) { return runChecks(cycle, {value}, 100); };
  CHECK(run(Scalar::of(54)).end == End::Passes);
  CHECK(run(Scalar::of(54)).at == nullptr);
  CHECK(run(Scalar::of(53)).end == End::Alarm);
  CHECK(run(Scalar::of(53)).at == &cycle.checks[5]);
  CHECK(run(Scalar{}).end == End::Unknown);
  CHECK(run(Scalar{}).at == &cycle.checks[0]);
  CHECK(run(Scalar::null()).end == End::Failed);
  CHECK(run(Scalar::of(59)).end == End::Failed);
  CHECK(run(Scalar::of(59)).at == &cycle.checks[2]);
  CHECK(run(Scalar::of(60)).end == End::Endless);
  CHECK(runChecks(cycle, {}, 100).end == End::Unknown);
  // Exactly as many steps as it takes.
  CHECK(runChecks(cycle, {Scalar::of(54)}, 4).end == End::Passes);
  CHECK(runChecks(cycle, {Scalar::of(54)}, 3).end == End::Endless);
}

TEST_CASE("ir: checks do not read a block whose meaning is not known") {
  Cycle cycle;
  cycle.checks = {statement(OpaqueBlock{}), statement(Alarm{"never"})};
  CHECK(runChecks(cycle, {}, 100).end == CheckRun::End::Unknown);
}
