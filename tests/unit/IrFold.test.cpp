// Folding: what vanishes, what stays, what is put in.
#include "ir/Evaluate.h"
#include "ir/Fold.h"
#include "tests/unit/IrHelper.h"

#include <algorithm>
#include <doctest/doctest.h>

using namespace dotek;
using namespace dotek::ir;
using namespace dotek::tests;

namespace {

const ExpressionPtr kA = variable(0);
const ExpressionPtr kB = variable(1);

ExpressionPtr add(const ExpressionPtr& a, const ExpressionPtr& b) {
  return binary(BinaryOp::Add, a, b);
}

void becomes(const ExpressionPtr& from, const ExpressionPtr& to) {
  CHECK(equal(simplify(from), to));
}

void stays(const ExpressionPtr& expression) {
  CHECK(simplify(expression) == expression);
}

// Two parameters a and b, one local c.
Cycle small() {
  Cycle cycle;
  cycle.add(parameter("a"));
  cycle.add(parameter("b"));
  cycle.add(local("c"));
  return cycle;
}

CycleStatement store(double number, const ExpressionPtr& value) {
  return statement(Store{constant(number), value});
}

const ExpressionPtr& stored(const CycleStatement& statement) {
  return std::get<Store>(statement.node).value;
}

} // namespace

TEST_CASE("ir: simplify takes out what does nothing") {
  becomes(add(kA, constant(0)), kA);
  becomes(add(constant(0), kA), kA);
  becomes(binary(BinaryOp::Subtract, kA, constant(0)), kA);
  becomes(binary(BinaryOp::Subtract, constant(0), kA), unary(UnaryOp::Negate, kA));
  becomes(binary(BinaryOp::Multiply, kA, constant(1)), kA);
  becomes(binary(BinaryOp::Multiply, constant(-1), kA), unary(UnaryOp::Negate, kA));
  becomes(binary(BinaryOp::Divide, kA, constant(1)), kA);
  becomes(unary(UnaryOp::Negate, unary(UnaryOp::Negate, kA)), kA);
  becomes(add(kA, unary(UnaryOp::Negate, kB)), binary(BinaryOp::Subtract, kA, kB));
  becomes(binary(BinaryOp::Subtract, kA, unary(UnaryOp::Negate, kB)), add(kA, kB));
  becomes(add(constant(1), add(constant(2), constant(3))), constant(6));
  becomes(unary(UnaryOp::Sine, constant(90)), constant(1));
  becomes(unary(UnaryOp::NullAsZero, nullValue()), constant(0));
  becomes(unary(UnaryOp::NullAsZero, add(kA, kB)), add(kA, kB));
  becomes(binary(BinaryOp::ValueOr, nullValue(), kA), kA);
  becomes(binary(BinaryOp::ValueOr, constant(5), kA), constant(5));
  becomes(binary(BinaryOp::ValueOr, kA, nullValue()), kA);
}

TEST_CASE("ir: simplify leaves what would round otherwise, or fail") {
  stays(add(add(kA, constant(1)), constant(2)));
  stays(binary(BinaryOp::Multiply, kA, constant(0))); // a may have no value
  stays(binary(BinaryOp::Subtract, kA, kA));
  stays(binary(BinaryOp::Divide, constant(1), constant(0)));
  stays(unary(UnaryOp::NullAsZero, kA));
  stays(binary(BinaryOp::ValueOr, kA, kB));
  stays(machineVariable(constant(550)));
  stays(result(ResultName::Main));
}

TEST_CASE("ir: digits stay with the constant") {
  const auto literal = constant(5, {0, 1, 3}, "5.");
  const auto sum = simplify(add(literal, constant(0)));
  CHECK(std::get<Constant>(sum->node).digits == "5.");
  CHECK(sum->range == SourceRange{0, 1, 3});
  const auto negative = simplify(unary(UnaryOp::Negate, literal));
  CHECK(std::get<Constant>(negative->node).digits == "-5.");
  CHECK(std::get<Constant>(negative->node).value == -5);
  const auto back = simplify(unary(UnaryOp::Negate, negative));
  CHECK(std::get<Constant>(back->node).digits == "5.");
  CHECK(std::get<Constant>(simplify(add(literal, literal))->node).digits.empty());
}

TEST_CASE("ir: conditions are decided") {
  const auto open = compare(Relation::Less, kA, constant(1));
  const auto failing =
      compare(Relation::Less, binary(BinaryOp::Divide, constant(1), constant(0)), constant(1));
  const auto is = [](const ConditionPtr& from, const ConditionPtr& to) { CHECK(equal(simplify(from), to)); };
  is(compare(Relation::Less, constant(1), constant(2)), truth(true));
  is(compare(Relation::Equal, constant(1), constant(2)), truth(false));
  is(join(Connective::And, truth(true), open), open);
  is(join(Connective::And, open, truth(false)), truth(false));
  is(join(Connective::Or, open, truth(true)), truth(true));
  is(join(Connective::Or, truth(false), open), open);
  is(isNull(constant(0)), truth(false));
  is(isNull(nullValue()), truth(true));
  is(isNull(add(kA, kB)), truth(false));
  is(isNull(kA), isNull(kA));
  is(failing, failing);
  is(negate(open), compare(Relation::GreaterEqual, kA, constant(1)));
  is(negate(isNull(constant(0))), truth(true));
}

TEST_CASE("ir: fold takes the branch that the values decide") {
  Cycle cycle = small();
  const LabelId other = cycle.addLabel({"other", {}});
  const LabelId end = cycle.addLabel({"end", {}});
  cycle.body = {statement(Branch{compare(Relation::Greater, kA, constant(0)), other}),
                store(1, kB),
                statement(Jump{end}),
                statement(Label{other}),
                store(2, add(kA, kB)),
                statement(Label{end}),
                store(3, kA)};
  Cycle positive = cycle;
  fold(positive, {{0, 5}});
  REQUIRE(positive.body.size() == 2);
  CHECK(equal(stored(positive.body[0]), add(constant(5), kB)));
  CHECK(equal(stored(positive.body[1]), constant(5)));
  CHECK_FALSE(uses(positive, 0));
  CHECK(uses(positive, 1));

  Cycle negative = cycle;
  fold(negative, {{0, -5}});
  REQUIRE(negative.body.size() == 2);
  CHECK(equal(stored(negative.body[0]), kB));

  Cycle open = cycle;
  fold(open, {{1, 7}});
  REQUIRE(open.body.size() == 7);
  CHECK(equal(stored(open.body[1]), constant(7)));
  CHECK(equal(stored(open.body[4]), add(kA, constant(7))));
  CHECK(uses(open, 0));
}

TEST_CASE("ir: fold carries constants where all paths agree") {
  Cycle cycle = small();
  const LabelId other = cycle.addLabel({"other", {}});
  const LabelId end = cycle.addLabel({"end", {}});
  const auto diamond = [&](double first, double second) {
    return std::vector{statement(Branch{compare(Relation::Greater, kA, constant(0)), other}),
                       statement(Assign{2, constant(first)}),
                       statement(Jump{end}),
                       statement(Label{other}),
                       statement(Assign{2, constant(second)}),
                       statement(Label{end}),
                       store(3, variable(2))};
  };
  cycle.body = diamond(4, 4);
  fold(cycle, {});
  REQUIRE(cycle.body.size() == 1); // the branch leads to the same place either way
  CHECK(equal(stored(cycle.body[0]), constant(4)));

  cycle.body = diamond(4, 5);
  fold(cycle, {});
  REQUIRE(cycle.body.size() == 7);
  CHECK(equal(stored(cycle.body[6]), variable(2)));
}

TEST_CASE("ir: a parameter that the cycle changes is fixed until then") {
  Cycle cycle = small();
  cycle.body = {store(1, kA), statement(Assign{0, add(kA, kB)}), store(2, kA)};
  fold(cycle, {{0, 5}});
  REQUIRE(cycle.body.size() == 3);
  CHECK(equal(stored(cycle.body[0]), constant(5)));
  CHECK(equal(std::get<Assign>(cycle.body[1].node).value, add(constant(5), kB)));
  CHECK(equal(stored(cycle.body[2]), kA));
}

TEST_CASE("ir: the body begins with what the checks leave") {
  Cycle cycle = small();
  const LabelId good = cycle.addLabel({"good", {}});
  cycle.checks = {statement(Branch{compare(Relation::Greater, kA, constant(0)), good}),
                  statement(Alarm{"a is not above 0"}), statement(Label{good}),
                  statement(Assign{2, add(kA, constant(1))}), statement(Assign{0, constant(9)})};
  cycle.body = {store(1, kA), store(2, variable(2))};
  Cycle fixed = cycle;
  fold(fixed, {{0, 5}});
  CHECK(fixed.checks.empty());
  CHECK(equal(stored(fixed.body[0]), constant(9)));
  CHECK(equal(stored(fixed.body[1]), constant(6)));

  Cycle open = cycle;
  fold(open, {});
  CHECK(equal(stored(open.body[0]), constant(9)));
  CHECK(equal(stored(open.body[1]), variable(2)));
  CHECK(open.checks.size() == 5);

  Cycle wrong = cycle;
  fold(wrong, {{0, -5}});
  REQUIRE(wrong.checks.size() == 1);
  CHECK(std::get<Alarm>(wrong.checks[0].node).message == "a is not above 0");
  // The checks have no end, so the body keeps what they would have assigned.
  CHECK(equal(stored(wrong.body[0]), kA));
}

TEST_CASE("ir: dead assignments go, in circles too, but not those that may fail") {
  Cycle cycle = small();
  const VariableId d = cycle.add(local("d"));
  cycle.body = {statement(Assign{2, variable(d)}), statement(Assign{d, add(variable(2), kA)}), store(1, kB)};
  fold(cycle, {});
  CHECK(cycle.body.size() == 1);

  cycle.body = {statement(Assign{2, binary(BinaryOp::Divide, constant(1), kA)})};
  fold(cycle, {});
  REQUIRE(cycle.body.size() == 1);
  fold(cycle, {{0, 0}});
  REQUIRE(cycle.body.size() == 1); // 1/0: the machine stops there
  fold(cycle, {{0, 4}});
  CHECK(cycle.body.size() == 1); // the 0 was put in by the fold before
}

TEST_CASE("ir: null is carried where it may appear") {
  Cycle cycle = small();
  const LabelId end = cycle.addLabel({"end", {}});
  cycle.body = {statement(Assign{2, nullValue()}),
                store(1, unary(UnaryOp::NullAsZero, variable(2))),
                store(2, binary(BinaryOp::ValueOr, variable(2), kA)),
                statement(Branch{isNull(variable(2)), end}),
                store(3, kA),
                statement(Label{end}),
                statement(OpaqueBlock{{Word{'X', variable(2), {}}}}),
                store(4, add(variable(2), kA))};
  fold(cycle, {});
  REQUIRE(cycle.body.size() == 5);
  CHECK(equal(stored(cycle.body[1]), constant(0)));
  CHECK(equal(stored(cycle.body[2]), kA));
  CHECK(equal(std::get<OpaqueBlock>(cycle.body[3].node).words[0].value, nullValue()));
  CHECK(equal(stored(cycle.body[4]), add(variable(2), kA))); // no null in arithmetic, even where it fails
}

namespace {

// for c = 1 to 3: #100 = c; b at the end of each turn where `guarded`
Cycle loop(bool guarded) {
  Cycle cycle = small();
  const LabelId head = cycle.addLabel({"head", {}});
  const LabelId end = cycle.addLabel({"end", {}});
  cycle.body = {statement(Assign{2, constant(1)}),
                statement(Label{head}),
                statement(Branch{compare(Relation::Greater, variable(2), constant(3)), end}),
                store(100, variable(2)),
                statement(Branch{guarded ? compare(Relation::Equal, kB, constant(0)) : truth(false), end}),
                statement(Assign{2, add(variable(2), constant(1))}),
                statement(Jump{head}),
                statement(Label{end})};
  return cycle;
}

} // namespace

TEST_CASE("ir: a loop stays unless it is unrolled") {
  Cycle kept = loop(false);
  fold(kept, {});
  REQUIRE(kept.body.size() == 7); // the branch that is never taken is gone
  CHECK(equal(stored(kept.body[3]), variable(2)));

  Cycle flat = loop(false);
  fold(flat, {}, {true, 100});
  REQUIRE(flat.body.size() == 3);
  for (std::size_t i = 0; i < 3; ++i)
    CHECK(equal(stored(flat.body[i]), constant(static_cast<double>(i + 1))));

  // 1 + 3 turns of 5 + the last look at the bound: with fewer steps the loop stays.
  Cycle bounded = loop(false);
  fold(bounded, {}, {true, 10});
  CHECK(bounded.body.size() == 7);

  // A way out that is not decided leads forward from each turn.
  Cycle undecided = loop(true);
  fold(undecided, {}, {true, 100});
  REQUIRE(undecided.body.size() == 6); // store, branch, store, branch, store, label
  for (const std::size_t i : {0, 2, 4})
    CHECK(equal(stored(undecided.body[i]), constant(static_cast<double>(i / 2 + 1))));
  const LabelId out = std::get<Label>(undecided.body[5].node).label;
  CHECK(std::get<Branch>(undecided.body[1].node).target == out);
  CHECK(std::get<Branch>(undecided.body[3].node).target == out);
  // How often it goes round is not decided.
  Cycle open = loop(false);
  open.body[2] = statement(
      Branch{compare(Relation::Greater, variable(2), kA), std::get<Branch>(open.body[2].node).target});
  fold(open, {}, {true, 100});
  CHECK(std::any_of(open.body.begin(), open.body.end(),
                    [](const CycleStatement& one) { return std::holds_alternative<Jump>(one.node); }));
  Cycle decided = loop(true);
  fold(decided, {{1, 0}}, {true, 100});
  REQUIRE(decided.body.size() == 1);
  CHECK(equal(stored(decided.body[0]), constant(1)));
}

TEST_CASE("ir: an endless loop stays endless") {
  Cycle cycle = small();
  const LabelId head = cycle.addLabel({"head", {}});
  cycle.checks = {statement(Label{head}), statement(Jump{head})};
  fold(cycle, {}, {true, 1000});
  CHECK(runChecks(cycle, {}, 1000).end == CheckRun::End::Endless);
}

TEST_CASE("ir: a list too large to follow its paths is folded cautiously") {
  Cycle cycle;
  const VariableId a = cycle.add(parameter("a"));
  constexpr VariableId kMany = 1000;
  for (VariableId i = 0; i < kMany; ++i)
    cycle.add(local("v" + std::to_string(i)));
  for (VariableId i = 0; i < kMany; ++i) {
    const LabelId label = cycle.addLabel({"skip", {}});
    cycle.body.push_back(statement(Assign{i + 1, constant(i)}));
    cycle.body.push_back(
        statement(Branch{compare(Relation::Equal, machineVariable(constant(i)), constant(0)), label}));
    cycle.body.push_back(store(i, add(variable(i + 1), variable(a))));
    cycle.body.push_back(statement(Label{label}));
  }
  cycle.body.push_back(store(0, variable(1)));
  fold(cycle, {{a, 1}});
  CHECK(equal(stored(cycle.body[2]), constant(1)));
  CHECK(equal(stored(cycle.body.back()), variable(1))); // known on all paths, but not looked for
  CHECK_FALSE(uses(cycle, a));
}
