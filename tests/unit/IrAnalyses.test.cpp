// Linear proofs, positions, measurements, kinds.
#include "ir/InferKinds.h"
#include "ir/Linear.h"
#include "ir/Positions.h"
#include "ir/Print.h"
#include "ir/ShareVariables.h"
#include "ir/Verify.h"
#include "tests/unit/IrHelper.h"

#include <doctest/doctest.h>

using namespace dotek;
using namespace dotek::ir;
using namespace dotek::tests;

namespace {

const ExpressionPtr kA = variable(0);
const ExpressionPtr kB = variable(1);

ExpressionPtr plus(const ExpressionPtr& a, const ExpressionPtr& b) {
  return binary(BinaryOp::Add, a, b);
}
ExpressionPtr minus(const ExpressionPtr& a, const ExpressionPtr& b) {
  return binary(BinaryOp::Subtract, a, b);
}
ExpressionPtr times(const ExpressionPtr& a, const ExpressionPtr& b) {
  return binary(BinaryOp::Multiply, a, b);
}
ExpressionPtr over(const ExpressionPtr& a, const ExpressionPtr& b) {
  return binary(BinaryOp::Divide, a, b);
}

Cycle abc() {
  Cycle cycle;
  for (const char* name : {"a", "b", "c"})
    cycle.add(parameter(name));
  return cycle;
}

bool proven(const ExpressionPtr& a, const ExpressionPtr& b) {
  return provenEqual(a, b, abc());
}

CycleStatement to(std::size_t axis, const ExpressionPtr& value, Frame frame,
                  ProbePoint point = ProbePoint::Centre) {
  Move move;
  move.axes[axis] = Coordinate{value, frame, nullptr};
  move.point = point;
  return statement(move);
}

CycleStatement touchX(const ExpressionPtr& system) {
  Measure measure;
  measure.target = Coordinate{constant(10), Frame::Here, nullptr};
  if (system) measure.setting = OffsetSetting{system, {constant(0), nullptr, nullptr}};
  return statement(measure);
}

// Position after the statements.
Position behind(std::vector<CycleStatement> body) {
  Cycle cycle = abc();
  cycle.addLabel({"l", {}});
  body.push_back(statement(Return{}));
  cycle.body = std::move(body);
  return positions(cycle).back();
}

using State = AxisPosition::State;

} // namespace

TEST_CASE("ir: linear forms") {
  const auto form =
      linear(minus(plus(times(constant(2), kA), kB), over(plus(kA, constant(3)), constant(2))), abc());
  REQUIRE(form.has_value());
  CHECK(form->constant == -1.5);
  CHECK(form->terms == std::map<std::string, double>{{"a", 1.5}, {"b", 1}});
  CHECK(linear(minus(kA, kA), abc()) == LinearForm{});
  CHECK(linear(over(kA, constant(0)), abc()) == std::nullopt);
  CHECK(linear(plus(kA, unary(UnaryOp::SquareRoot, constant(-1))), abc()) == std::nullopt);
  CHECK(linear(nullValue(), abc()) == std::nullopt);
}

TEST_CASE("ir: what is proved equal") {
  CHECK(proven(plus(kA, kB), plus(kB, kA)));
  CHECK(proven(minus(plus(kA, kB), kA), kB));
  CHECK(proven(unary(UnaryOp::Negate, minus(kA, kB)), minus(kB, kA)));
  CHECK(proven(plus(constant(0.1), constant(0.2)), constant(0.3))); // decimals, as people write them
  CHECK(proven(plus(constant(-10.3), constant(10.1)), constant(-0.2)));
  CHECK(proven(over(kA, constant(4)), times(kA, constant(0.25))));
  const auto sine = unary(UnaryOp::Sine, plus(kA, constant(5, {}, "5.")));
  CHECK(proven(minus(plus(kB, sine), unary(UnaryOp::Sine, plus(kA, constant(5)))), kB));
  CHECK(proven(over(kA, constant(3)), over(kA, constant(3))));
  CHECK(proven(result(ResultName::Main), result(ResultName::Main)));
}

TEST_CASE("ir: what is not proved equal") {
  CHECK_FALSE(proven(kA, kB));
  CHECK_FALSE(proven(kA, unary(UnaryOp::Negate, kA)));
  CHECK_FALSE(proven(kA, plus(kA, constant(0.001))));
  CHECK_FALSE(proven(result(ResultName::Main), result(ResultName::Size)));
  CHECK_FALSE(proven(unary(UnaryOp::NullAsZero, kA), kA));
  // 1e17 + 1 rounds: it is not 1e17.
  CHECK_FALSE(proven(plus(constant(1e17), constant(1)), constant(1e17)));
  CHECK_FALSE(proven(minus(plus(kA, constant(1e17)), constant(1e17 + 16)), minus(kA, constant(15))));
  CHECK_FALSE(proven(over(constant(1), constant(0)), over(constant(1), constant(0))));
}

TEST_CASE("ir: variables of one name are two symbols") {
  Cycle cycle;
  cycle.add(parameter("a"));
  cycle.add(local("a"));
  CHECK_FALSE(provenEqual(variable(0), variable(1), cycle));
}

TEST_CASE("ir: exact sums and products of decimals") {
  CHECK(exactSum(0.1, 0.2) == 0.3);
  CHECK(exactSum(1e17, 1) == std::nullopt);
  CHECK(exactSum(1e-300, 1) == std::nullopt);
  CHECK(exactSum(5, -5) == 0.0);
  CHECK(exactProduct(0.1, 3) == 0.3);
  CHECK(exactProduct(1.0 / 3, 3) == 0.9999999999999999);
  CHECK(exactProduct(-0.5, 4) == -2.0);
  CHECK(exactProduct(0, 1e300) == 0.0);
  CHECK(exactProduct(1e300, 1e300) == std::nullopt);
  CHECK(exactProduct(123456789.123, 987654321.987) == std::nullopt);
}

TEST_CASE("ir: positions follow the moves") {
  const Position entry = behind({});
  CHECK(entry[0].state == State::Start);
  CHECK(equal(entry[0].value, constant(0)));
  const Position moved =
      behind({to(0, kA, Frame::Work), to(0, kB, Frame::Here), to(1, constant(5), Frame::Here),
              to(1, constant(0.1), Frame::Here), to(2, kA, Frame::Retract)});
  CHECK(moved[0].state == State::Work);
  CHECK(equal(moved[0].value, plus(kA, kB)));
  CHECK(moved[1].state == State::Start);
  CHECK(equal(moved[1].value, constant(5.1)));
  CHECK(moved[2].state == State::Unknown);
  CHECK(moved[2].value == nullptr);
  CHECK(behind({to(0, kA, Frame::Start)})[0].state == State::Start);
  CHECK(behind({to(0, kA, Frame::Machine)})[0].state == State::Unknown);
  CHECK(behind({to(0, kA, Frame::Machine), to(0, kB, Frame::Here)})[0].state == State::Unknown);
  CHECK(behind({to(0, machineVariable(constant(1)), Frame::Work)})[0].state == State::Unknown);
}

TEST_CASE("ir: positions say which point they mean") {
  CHECK(behind({to(2, kA, Frame::Work, ProbePoint::Lowest)})[2].point == ProbePoint::Lowest);
  CHECK(behind({to(0, kA, Frame::Work, ProbePoint::Lowest)})[0].point == ProbePoint::Centre);
  CHECK(behind({to(0, kA, Frame::Work, ProbePoint::Contact)})[0].state == State::Unknown);
}

TEST_CASE("ir: what makes a position unknown") {
  const auto start = to(0, kA, Frame::Work);
  CHECK(behind({start, statement(Assign{0, constant(1)})})[0].state == State::Unknown);
  CHECK(behind({start, statement(Assign{1, constant(1)})})[0].state == State::Work);
  CHECK(behind({start, statement(OpaqueBlock{})})[0].state == State::Unknown);
  CHECK(behind({statement(OpaqueBlock{})})[2].state == State::Unknown);
  CHECK(behind({start, statement(SetMode{Mode::WorkSystem, constant(55)})})[0].state == State::Unknown);
  CHECK(behind({start, statement(SetMode{Mode::Absolute, nullptr})})[0].state == State::Work);
  // A measurement comes back; the system that it sets may be the active one.
  CHECK(behind({start, touchX(nullptr)})[0].state == State::Work);
  CHECK(behind({start, touchX(constant(56))})[0].state == State::Unknown);
  CHECK(behind({to(1, kA, Frame::Work), touchX(constant(56))})[1].state == State::Work);
  const auto other = statement(SetMode{Mode::WorkSystem, constant(54)});
  CHECK(behind({other, start, touchX(constant(56))})[0].state == State::Work);
  CHECK(behind({other, start, touchX(constant(54))})[0].state == State::Unknown);
  CHECK(behind({other, start, touchX(kB)})[0].state == State::Unknown);
  // What the last measurement found is another value after the next.
  const auto found = to(1, result(ResultName::PositionY), Frame::Work);
  CHECK(behind({touchX(nullptr), found})[1].state == State::Work);
  CHECK(behind({touchX(nullptr), found, touchX(nullptr)})[1].state == State::Unknown);
}

TEST_CASE("ir: a variable that holds the place lasts longer than what the place was computed of") {
  const auto start = to(0, kA, Frame::Work), copy = statement(Assign{1, kA});
  const auto changed = statement(Assign{0, constant(1)});
  const AxisPosition held = behind({start, copy, changed})[0];
  CHECK(held.state == State::Work);
  CHECK(equal(held.value, kB));
  CHECK(behind({start, copy, statement(Assign{1, constant(2)}), changed})[0].state == State::Unknown);
  CHECK(behind({start, copy, to(0, constant(5), Frame::Here), changed})[0].state == State::Unknown);
  CHECK(behind({copy, start, changed})[0].state == State::Unknown);
  CHECK(behind({start, copy, statement(SetMode{Mode::WorkSystem, constant(55)}), changed})[0].state ==
        State::Unknown);
  const auto branch = statement(Branch{compare(Relation::Less, kA, constant(0)), 0});
  CHECK(behind({start, branch, copy, statement(Label{0}), changed})[0].state == State::Unknown);
}

TEST_CASE("ir: positions meet where paths do") {
  const auto branch = statement(Branch{compare(Relation::Less, kA, constant(0)), 0});
  const auto label = statement(Label{0});
  CHECK(behind({branch, to(0, kA, Frame::Work), label})[0].state == State::Unknown);
  CHECK(behind({branch, to(0, kA, Frame::Work), label})[1].state == State::Start);
  CHECK(behind({to(0, kA, Frame::Work), branch, to(0, kA, Frame::Work), label})[0].state == State::Work);
  // A loop of travels.
  CHECK(behind({label, to(0, constant(1), Frame::Here), branch})[0].state == State::Unknown);
  Cycle dead = abc();
  dead.body = {statement(Return{}), statement(Comment{"nobody"})};
  CHECK(positions(dead)[1][0].state == State::Unknown);
}

TEST_CASE("ir: many travels do not make a large position") {
  std::vector<CycleStatement> body;
  for (int i = 0; i < 5000; ++i)
    body.push_back(to(0, kA, Frame::Here));
  CHECK(behind(body)[0].state == State::Unknown);
  body.resize(50);
  CHECK(behind(body)[0].state == State::Start);
}

TEST_CASE("ir: the last measurement") {
  Cycle cycle = abc();
  cycle.addLabel({"l", {}});
  cycle.body = {statement(Comment{"before"}),
                touchX(nullptr),
                statement(Branch{compare(Relation::Less, kA, constant(0)), 0}),
                touchX(constant(54)),
                statement(Label{0}),
                statement(Comment{"which"}),
                touchX(nullptr),
                statement(OpaqueBlock{}),
                statement(Return{})};
  const auto last = lastMeasurements(cycle);
  REQUIRE(last.size() == cycle.body.size());
  CHECK(last[0] == nullptr);
  CHECK(last[2] == &cycle.body[1]);
  CHECK(last[3] == last[2]);
  CHECK(last[4] == nullptr);
  CHECK(last[5] == nullptr);
  CHECK(last[7] == &cycle.body[6]);
  CHECK(last[8] == nullptr);
}

TEST_CASE("ir: a work variable that is set twice ties no kinds together") {
  Cycle cycle;
  for (const char* name : {"x", "g"})
    cycle.add(parameter(name));
  Variable work;
  work.name = "t";
  cycle.add(work);
  cycle.checks = {statement(Assign{2, unary(UnaryOp::Absolute, variable(0))}),
                  statement(Assign{2, binary(BinaryOp::Subtract, variable(1), constant(54))})};
  Move move;
  move.axes[0] = Coordinate{variable(0), Frame::Work, variable(1)};
  cycle.body = {statement(move)};
  inferKinds(cycle);
  CHECK(cycle.variables[0].kind == Kind::Length);
  CHECK(cycle.variables[1].kind == Kind::WorkOffset);
  CHECK(cycle.variables[2].kind == Kind::Number);
  CHECK(verify(cycle).empty());
}

TEST_CASE("ir: kinds follow from use") {
  Cycle cycle;
  for (const char* name : {"x", "g", "f", "w", "limit", "half", "other", "count", "plain"})
    cycle.add(parameter(name));
  const auto v = [](VariableId id) { return variable(id); };
  cycle.addLabel({"l", {}});
  cycle.checks = {statement(Branch{compare(Relation::Greater, v(0), v(4)), 0}), statement(Label{0}),
                  statement(Assign{5, over(v(4), constant(2))}),
                  statement(Assign{6, plus(v(5), times(v(7), v(8)))})};
  Move move;
  move.axes[0] = Coordinate{plus(v(0), times(constant(2), unary(UnaryOp::Sine, v(3)))), Frame::Work, v(1)};
  move.feed = v(2);
  cycle.body = {statement(move)};
  inferKinds(cycle);
  const auto kind = [&](VariableId id) { return cycle.variables[id].kind; };
  CHECK(kind(0) == Kind::Length);
  CHECK(kind(1) == Kind::WorkOffset);
  CHECK(kind(2) == Kind::Feed);
  CHECK(kind(3) == Kind::Angle);
  CHECK(kind(4) == Kind::Length); // compared with x
  CHECK(kind(5) == Kind::Length); // half of it
  CHECK(kind(6) == Kind::Length); // a sum with it
  CHECK(kind(7) == Kind::Number); // a factor may be anything
  CHECK(kind(8) == Kind::Number);
}

// a is needed for the first value only; b to the end.
TEST_CASE("ir: locals share with one another, and with arguments that nothing needs any more") {
  const auto shared = [](Sharing sharing) {
    Cycle cycle = abc();
    const VariableId x = cycle.add(local("x")), y = cycle.add(local("y", Kind::Angle)),
                     z = cycle.add(local("z"));
    cycle.body = {statement(Assign{x, plus(kA, constant(1))}), statement(Assign{y, plus(variable(x), kB)}),
                  statement(Assign{z, kB}), statement(Store{constant(500), plus(variable(y), variable(z))}),
                  statement(Store{constant(501), kB})};
    shareVariables(cycle, sharing);
    std::vector<VariableId> assigned;
    for (const CycleStatement& one : cycle.body)
      if (const auto* assign = std::get_if<Assign>(&one.node)) assigned.push_back(assign->variable);
    return assigned;
  };
  // x ends where y, an angle, and z begin.
  CHECK(shared(Sharing::Locals) == std::vector<VariableId>{3, 4, 3});
  // x and y take the place of a; z is b all the time. c is no argument, as nothing reads it.
  CHECK(shared(Sharing::Arguments) == std::vector<VariableId>{0, 0});
}

TEST_CASE("ir: what is compared with a result is of its kind") {
  Cycle cycle;
  for (const char* name : {"tilt", "play", "hole", "any"})
    cycle.add(parameter(name));
  cycle.addLabel({"l", {}});
  const auto beyond = [](ResultName name, VariableId limit) {
    const ExpressionPtr size = unary(UnaryOp::Absolute, result(name));
    return statement(Branch{compare(Relation::Greater, size, variable(limit)), 0});
  };
  cycle.body = {beyond(ResultName::AngleErrorY, 0), beyond(ResultName::TruePosition, 1),
                beyond(ResultName::Hole, 2), beyond(ResultName::Main, 3), statement(Label{0})};
  inferKinds(cycle);
  CHECK(cycle.variables[0].kind == Kind::Angle);
  CHECK(cycle.variables[1].kind == Kind::Length);
  CHECK(cycle.variables[2].kind == Kind::Number);
  CHECK(cycle.variables[3].kind == Kind::Number); // of an angle or of a length
}

TEST_CASE("ir: a declared kind stays, and of two uses the first counts") {
  Cycle cycle;
  cycle.add(parameter("g", Kind::WorkOffset));
  cycle.add(parameter("both"));
  Move move;
  move.axes[0] = Coordinate{variable(0), Frame::Work, nullptr};
  Move feed;
  feed.axes[0] = Coordinate{variable(1), Frame::Work, nullptr};
  feed.feed = variable(1);
  cycle.body = {statement(move), statement(feed)};
  inferKinds(cycle);
  CHECK(cycle.variables[0].kind == Kind::WorkOffset);
  CHECK(cycle.variables[1].kind == Kind::Length);
}
