// Properties of the IR on random expressions, conditions and cycles. The seed is fixed: a failure repeats.
#include "ir/Evaluate.h"
#include "ir/Fold.h"
#include "ir/Linear.h"
#include "ir/Print.h"
#include "ir/Verify.h"
#include "tests/unit/IrHelper.h"

#include <cmath>
#include <doctest/doctest.h>
#include <limits>
#include <random>

using namespace dotek;
using namespace dotek::ir;
using namespace dotek::tests;

namespace {

constexpr std::uint32_t kVariables = 5;

class Random {
public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}
  // 0 up to `bound` - 1.
  std::uint32_t below(std::uint32_t bound) { return static_cast<std::uint32_t>(engine_() % bound); }
  bool once(std::uint32_t times) { return below(times) == 0; }

  double number() {
    static constexpr double kNumbers[] = {0, 1, -1, 2, 0.5, 10, -0.1, 90, 3.3};
    return kNumbers[below(std::size(kNumbers))];
  }

  // `nullable`: the value may be null.
  ExpressionPtr expression(int depth, bool nullable) {
    if (nullable && once(6)) return nullValue();
    if (depth == 0 || once(5)) {
      if (once(3)) return variable(below(nullable ? kVariables : kVariables - 1));
      return once(8) ? result(ResultName::Main) : constant(number());
    }
    if (once(3)) {
      const auto op = static_cast<UnaryOp>(below(static_cast<std::uint32_t>(kLastUnaryOp) + 1));
      return unary(op, expression(depth - 1, op == UnaryOp::NullAsZero));
    }
    auto op = static_cast<BinaryOp>(below(static_cast<std::uint32_t>(kLastBinaryOp) + 1));
    if (!once(3)) op = static_cast<BinaryOp>(below(4)); // + - * / mostly
    const bool valueOr = op == BinaryOp::ValueOr;
    return binary(op, expression(depth - 1, valueOr), expression(depth - 1, valueOr && nullable));
  }

  ConditionPtr condition(int depth) {
    if (depth > 0 && once(2))
      return join(once(2) ? Connective::And : Connective::Or, condition(depth - 1), condition(depth - 1));
    if (depth > 0 && once(4))
      return std::make_shared<const Condition>(Condition{{}, Not{condition(depth - 1)}});
    if (once(5)) return isNull(expression(2, true));
    if (once(12)) return truth(once(2));
    return compare(static_cast<Relation>(below(static_cast<std::uint32_t>(kLastRelation) + 1)),
                   expression(2, false), expression(2, false));
  }

  // The last variable is the only one that may be null.
  Environment environment(bool complete) {
    Environment out;
    for (std::uint32_t i = 0; i < kVariables; ++i)
      out.push_back(!complete && once(4) ? Scalar{} : Scalar::of(number()));
    if (once(2)) out.back() = Scalar::null();
    return out;
  }

private:
  std::mt19937 engine_;
};

bool same(const Scalar& a, const Scalar& b) {
  return a.state == b.state && (!a.known() || a.value == b.value);
}

Cycle declared() {
  Cycle cycle;
  for (std::uint32_t i = 0; i < kVariables; ++i)
    cycle.add(parameter("v" + std::to_string(i)));
  cycle.variables.back().optional = true;
  return cycle;
}

// Assignments, branches, jumps and alarms; jumps go anywhere.
Cycle randomChecks(Random& random) {
  Cycle cycle = declared();
  std::vector<LabelId> labels;
  for (int i = 0; i < 4; ++i)
    labels.push_back(cycle.addLabel({"l", {}}));
  const auto anyLabel = [&] { return labels[random.below(4)]; };
  std::size_t placed = 0;
  for (int i = 0; i < 24; ++i) {
    const std::uint32_t kind = random.below(10);
    if (kind < 4)
      cycle.checks.push_back(statement(Assign{random.below(kVariables - 1), random.expression(2, false)}));
    else if (kind < 7)
      cycle.checks.push_back(statement(Branch{random.condition(1), anyLabel()}));
    else if (kind == 7)
      cycle.checks.push_back(statement(Alarm{"alarm " + std::to_string(i)}));
    else if (kind == 8 && random.once(3))
      cycle.checks.push_back(statement(Jump{anyLabel()}));
    else if (placed < labels.size())
      cycle.checks.push_back(statement(Label{labels[placed++]}));
  }
  while (placed < labels.size())
    cycle.checks.push_back(statement(Label{labels[placed++]}));
  return cycle;
}

const std::string& messageOf(const CheckRun& run) {
  return std::get<Alarm>(run.at->node).message;
}

} // namespace

TEST_CASE("ir: simplify keeps the value of random expressions") {
  Random random(1);
  std::size_t values = 0;
  for (int i = 0; i < 20000; ++i) {
    const auto expression = random.expression(5, true);
    const auto simple = simplify(expression);
    const Environment environment = random.environment(false);
    const Scalar before = evaluate(*expression, environment);
    const Scalar after = evaluate(*simple, environment);
    values += before.known();
    CHECK_MESSAGE(same(before, after), print(*expression, declared())
                                           << " became " << print(*simple, declared()));
    CHECK(equal(simplify(simple), simple));
  }
  CHECK(values > 2000);
}

TEST_CASE("ir: simplify and negate keep the truth of random conditions") {
  Random random(2);
  std::size_t decided = 0;
  for (int i = 0; i < 20000; ++i) {
    const auto condition = random.condition(3);
    const auto opposite = negate(condition);
    const Environment environment = random.environment(i % 2 == 0);
    const auto before = holds(*condition, environment);
    const auto after = holds(*simplify(condition), environment);
    const auto negated = holds(*opposite, environment);
    CHECK(negated.has_value() == before.has_value());
    if (!before) continue; // may be decided now: a sum is no null even where its value is unknown
    ++decided;
    CHECK_MESSAGE(before == after, print(*condition, declared()));
    CHECK(*negated == !*before);
  }
  CHECK(decided > 2000);
}

TEST_CASE("ir: folded checks end as the checks do") {
  using End = CheckRun::End;
  Random random(3);
  std::size_t alarms = 0;
  std::size_t passes = 0;
  for (int i = 0; i < 5000; ++i) {
    const Cycle cycle = randomChecks(random);
    CHECK(verify(cycle).empty());
    const Environment environment = random.environment(true);
    std::map<VariableId, double> some;
    for (VariableId id = 0; id < kVariables; ++id)
      if (environment[id].known() && (i % 3 == 0 || random.once(2))) some[id] = environment[id].value;
    const CheckRun before = runChecks(cycle, environment, 2000);
    if (before.end == End::Unknown) continue; // depends on the result of a measurement
    for (const bool unroll : {false, true}) {
      Cycle folded = cycle;
      fold(folded, some, {unroll, 500});
      CHECK(verify(folded).empty());
      const CheckRun after = runChecks(folded, environment, 2000);
      // A counter that nobody reads is dropped, though it would overflow in the end.
      if (before.end == End::Failed && after.end == End::Endless) continue;
      CHECK(after.end == before.end);
      if (before.end == End::Alarm && after.end == End::Alarm) CHECK(messageOf(after) == messageOf(before));
    }
    alarms += before.end == End::Alarm;
    passes += before.end == End::Passes;
  }
  CHECK(alarms > 500);
  CHECK(passes > 250);
}

TEST_CASE("ir: a linear proof never contradicts the values") {
  Random random(4);
  std::size_t proofs = 0;
  std::size_t compared = 0;
  std::size_t large = 0;
  const Cycle cycle = declared();
  for (int i = 0; i < 3000; ++i) {
    // Close relatives, so that many are equal: sums of the same few terms in another order.
    ExpressionPtr a = random.expression(1, false);
    ExpressionPtr b = random.expression(1, false);
    const auto left = binary(BinaryOp::Add, binary(BinaryOp::Subtract, a, b), b);
    const auto right = random.once(2) ? a : binary(BinaryOp::Add, b, binary(BinaryOp::Subtract, b, a));
    if (!provenEqual(left, right, cycle)) continue;
    ++proofs;
    const Environment environment = random.environment(true);
    const Scalar one = evaluate(*left, environment);
    const Scalar two = evaluate(*right, environment);
    if (!one.known() || !two.known()) continue;
    ++compared;
    // A proof is about exact numbers: what a sum of doubles loses depends on the largest of its terms alone.
    const double most = std::abs(evaluate(*a, environment).value) + std::abs(evaluate(*b, environment).value);
    if (most > 1e6) ++large;
    const double rounding = 8 * std::numeric_limits<double>::epsilon() * most;
    CHECK_MESSAGE(std::abs(one.value - two.value) <= rounding, print(*left, cycle)
                                                                   << " and " << print(*right, cycle));
  }
  CHECK(proofs > 500);
  CHECK(compared > 500);
  CHECK(large > 0);
}
