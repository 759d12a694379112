// Each thing that verify() demands, broken once.
#include "ir/Verify.h"
#include "tests/unit/IrHelper.h"

#include <doctest/doctest.h>
#include <limits>

using namespace dotek;
using namespace dotek::ir;
using namespace dotek::tests;

namespace {

enum Id : VariableId { kLength, kOffset, kFeed, kAngle, kOptional, kLocal };

Cycle good() {
  Cycle cycle;
  cycle.add(parameter("a", Kind::Length));
  cycle.add(parameter("G", Kind::WorkOffset));
  cycle.add(parameter("F", Kind::Feed));
  cycle.add(parameter("w", Kind::Angle));
  cycle.add(parameter("o", Kind::Number));
  cycle.variables.back().optional = true;
  cycle.add(local("v"));
  cycle.addLabel({"first", {}});
  cycle.addLabel({"there", {}});
  return cycle;
}

Move moveX(ExpressionPtr value, Frame frame = Frame::Work) {
  Move move;
  move.axes[0] = Coordinate{std::move(value), frame, nullptr};
  return move;
}

Measure surface() {
  Measure measure;
  measure.target = Coordinate{variable(kLength), Frame::Work, nullptr};
  return measure;
}

Measure bore() {
  Measure measure;
  measure.feature = Feature::Bore;
  measure.diameter = variable(kLength);
  return measure;
}

std::vector<Violation> inBody(std::vector<CycleStatement> body) {
  Cycle cycle = good();
  cycle.body = std::move(body);
  return verify(cycle);
}

// The one violation of a body of one statement.
Violation only(CycleStatement it) {
  it.origin.ranges = {{7, 1, 2}};
  const auto found = inBody({std::move(it)});
  REQUIRE(found.size() == 1);
  CHECK(found[0].range == SourceRange{7, 1, 2});
  return found[0];
}

void defect(CycleStatement it, const std::string& message) {
  const Violation found = only(std::move(it));
  CHECK(found.message == message);
  CHECK_FALSE(found.mixedKinds);
}

void mixed(CycleStatement it, const std::string& message) {
  const Violation found = only(std::move(it));
  CHECK(found.message == message);
  CHECK(found.mixedKinds);
}

template <class Node> void fine(Node node) {
  CHECK(inBody({statement(std::move(node))}).empty());
}

ExpressionPtr sum(VariableId a, VariableId b) {
  return binary(BinaryOp::Add, variable(a), variable(b));
}

const auto kOptionalNull = isNull(variable(kOptional));

} // namespace

TEST_CASE("ir: verify: what does not exist or is missing") {
  defect(statement(Store{constant(1), variable(99)}), "a variable does not exist");
  defect(statement(Assign{99, constant(1)}), "a variable does not exist");
  defect(statement(Assign{kLocal, nullptr}), "the value of an assignment is missing");
  defect(statement(Store{nullptr, constant(1)}), "the number of a machine variable is missing");
  defect(statement(Store{constant(1), unary(UnaryOp::Negate, nullptr)}), "an operand is missing");
  defect(statement(Store{constant(1), machineVariable(nullptr)}),
         "the number of a machine variable is missing");
  defect(statement(Jump{99}), "a label does not exist");
  defect(statement(Branch{nullptr, 0}), "a condition is missing");
  defect(statement(Dwell{nullptr}), "the time of a dwell is missing");
  CycleStatement named = statement(Return{});
  named.origin.arguments = {{'A', 99}};
  defect(std::move(named), "a variable of the origin does not exist");
}

TEST_CASE("ir: verify: labels") {
  const auto messages = [](const Cycle& cycle) {
    std::vector<std::string> out;
    for (const Violation& violation : verify(cycle))
      out.push_back(violation.message);
    return out;
  };
  using Messages = std::vector<std::string>;
  Cycle cycle = good();
  cycle.body = {statement(Jump{0}), statement(Label{0})};
  CHECK(messages(cycle).empty());
  cycle.body.push_back(statement(Label{0}));
  CHECK(messages(cycle) == Messages{"label `first` is placed twice"});
  cycle = good();
  cycle.checks = {statement(Label{0})};
  cycle.body = {statement(Jump{0})};
  CHECK(messages(cycle) == Messages{"a jump goes to label `first`, which its list does not hold"});
  cycle.body = {statement(Branch{truth(true), 0}), statement(Label{0})}; // once per list
  CHECK(messages(cycle).empty());
  cycle.labels[1].name = "first";
  CHECK(messages(cycle) == Messages{"two labels have the name `first`"});
}

TEST_CASE("ir: verify: numbers are finite") {
  defect(statement(Store{constant(1), constant(std::numeric_limits<double>::infinity())}),
         "a constant is no finite number");
  Cycle cycle = good();
  cycle.variables[kLength].defaultValue = std::numeric_limits<double>::quiet_NaN();
  REQUIRE(verify(cycle).size() == 1);
  CHECK(verify(cycle)[0].message == "the default of `a` is no finite number");
}

TEST_CASE("ir: verify: axes and frames") {
  fine(moveX(variable(kLength)));
  fine(surface());
  fine(bore());
  defect(statement(Move{}), "a move names no axis");
  defect(statement(moveX(nullptr)), "a coordinate is missing");
  defect(statement(moveX(variable(kLength), Frame::Retract)),
         "a coordinate along X or Y counts from the retract plane");
  Move system = moveX(variable(kLength), Frame::Here);
  system.axes[0]->system = variable(kOffset);
  defect(statement(system), "a coordinate names a work system and counts from another frame");
  Move retract;
  retract.axes[2] = Coordinate{variable(kLength), Frame::Retract, nullptr};
  fine(retract);

  Measure measure = surface();
  measure.target.reset();
  defect(statement(measure), "the measurement of a surface has no target");
  measure = surface();
  measure.diameter = constant(5);
  defect(statement(measure), "the measurement of a surface has a diameter");
  measure = bore();
  measure.diameter = nullptr;
  defect(statement(measure), "the diameter of a bore is missing");
  measure = bore();
  measure.target = surface().target;
  defect(statement(measure), "the measurement of a bore has a target");
  measure = surface();
  measure.setting = OffsetSetting{variable(kOffset), {nullptr, nullptr, nullptr}};
  defect(statement(measure), "a measurement sets a work system along no axis");
  measure.setting->nominal = {nullptr, constant(0), nullptr};
  defect(statement(measure), "a measurement sets an axis that it does not measure");
  measure.setting->nominal = {constant(0), nullptr, nullptr};
  fine(measure);
  measure.setting->system = nullptr;
  defect(statement(measure), "the work system of a measurement is missing");
  measure = bore();
  measure.setting = OffsetSetting{variable(kOffset), {constant(0), constant(0), constant(0)}};
  defect(statement(measure), "a measurement sets an axis that it does not measure");

  defect(statement(SetMode{Mode::WorkSystem, nullptr}), "the number of a work system is missing");
  defect(statement(SetMode{Mode::Absolute, constant(54)}), "a mode that is no work system names one");
  defect(statement(Spindle{Spindle::State::Off, constant(100)}), "a spindle that stops has a speed");
  defect(statement(OpaqueBlock{{Word{'#', constant(1), {}}}}), "a word has no letter");
}

TEST_CASE("ir: verify: kinds") {
  mixed(statement(moveX(sum(kLength, kOffset))), "`a + G` mixes the kinds length and work-offset");
  mixed(statement(moveX(variable(kFeed))), "`F` is of the kind feed; the kind length is needed here");
  mixed(statement(Assign{kFeed, variable(kLength)}), "`F` = `a` mixes the kinds feed and length");
  mixed(statement(Store{constant(1), binary(BinaryOp::ValueOr, variable(kLength), variable(kFeed))}),
        "`value_or(a, F)` mixes the kinds length and feed");
  mixed(statement(Store{constant(1), unary(UnaryOp::Sine, variable(kLength))}),
        "`sin(a)` mixes the kinds angle and length");
  mixed(statement(SetMode{Mode::WorkSystem, variable(kLength)}),
        "`a` is of the kind length; the kind work-offset is needed here");
  const auto both = compare(Relation::Less, variable(kLength), variable(kOffset));
  for (const auto& condition : {both, negate(both), join(Connective::And, truth(true), both)}) {
    const auto found = inBody({statement(Branch{condition, 0}), statement(Label{0})});
    REQUIRE(found.size() == 1);
    CHECK(found[0].mixedKinds);
  }
  // Products and quotients are free; numbers of no kind go with all.
  fine(moveX(binary(BinaryOp::Multiply, variable(kLength), constant(2))));
  fine(moveX(binary(BinaryOp::Add, variable(kLength), constant(2))));
  fine(moveX(binary(BinaryOp::Multiply, variable(kLength), unary(UnaryOp::Sine, variable(kAngle)))));
  fine(Assign{kLocal, sum(kLength, kLength)});
  fine(Store{constant(1), binary(BinaryOp::Divide, variable(kLength), variable(kFeed))});
  fine(Assign{kAngle, binary(BinaryOp::Direction, variable(kLength), variable(kLength))});
}

TEST_CASE("ir: verify: a finding is at the narrowest place") {
  const auto wrong = binary(BinaryOp::Add, variable(kLength), variable(kOffset), {7, 10, 15});
  CycleStatement it = statement(Store{constant(1), wrong});
  it.origin.ranges = {{7, 0, 20}};
  const auto found = inBody({it});
  REQUIRE(found.size() == 1);
  CHECK(found[0].range == SourceRange{7, 10, 15});
}

TEST_CASE("ir: verify: null") {
  const std::string message = "`o` may be null where a number is needed";
  defect(statement(Store{constant(1), variable(kOptional)}), message);
  defect(statement(Assign{kLocal, unary(UnaryOp::Negate, variable(kOptional))}), message);
  defect(statement(moveX(variable(kOptional))), message);
  defect(statement(Store{constant(1), nullValue()}), "`null` may be null where a number is needed");
  defect(statement(moveX(binary(BinaryOp::ValueOr, variable(kOptional), nullValue()))),
         "`value_or(o, null)` may be null where a number is needed");
  fine(Assign{kLocal, variable(kOptional)});
  fine(Assign{kLocal, nullValue()});
  fine(OpaqueBlock{{Word{'X', variable(kOptional), {}}}});
  fine(Store{constant(1), unary(UnaryOp::NullAsZero, variable(kOptional))});
  fine(Store{constant(1), binary(BinaryOp::ValueOr, variable(kOptional), constant(5))});

  // Null goes with assignments and ends with them.
  const auto use = statement(Store{constant(1), variable(kLocal)});
  CHECK(inBody({statement(Assign{kLocal, variable(kOptional)}), use}).size() == 1);
  CHECK(
      inBody({statement(Assign{kLocal, nullValue()}), statement(Assign{kLocal, constant(1)}), use}).empty());

  // A test says the paths apart.
  const auto read = statement(Store{constant(1), variable(kOptional)});
  const auto label = statement(Label{0});
  CHECK(inBody({statement(Branch{kOptionalNull, 0}), read, label}).empty());
  CHECK(inBody({statement(Branch{kOptionalNull, 0}), label, read}).size() == 1);
  CHECK(inBody({statement(Branch{kOptionalNull, 0}), statement(Return{}), label, read}).size() == 1);
  CHECK(inBody({statement(Branch{negate(kOptionalNull), 0}), statement(Return{}), label, read}).empty());
  const auto above = compare(Relation::Greater, variable(kOptional), constant(0));
  const auto tested = [&](Connective op, const ConditionPtr& test) {
    return inBody({statement(Branch{join(op, test, above), 0}), label}).size();
  };
  CHECK(tested(Connective::And, negate(kOptionalNull)) == 0);
  CHECK(tested(Connective::Or, kOptionalNull) == 0);
  CHECK(tested(Connective::And, kOptionalNull) == 1);

  // The checks come before the body; a default leaves nothing null.
  Cycle cycle = good();
  cycle.checks = {statement(Branch{negate(kOptionalNull), 0}), statement(Alarm{"o is missing"}), label};
  cycle.body = {read};
  CHECK(verify(cycle).empty());
  cycle.checks.clear();
  CHECK(verify(cycle).size() == 1);
  cycle.variables[kOptional].defaultValue = 5;
  CHECK(verify(cycle).empty());
}

TEST_CASE("ir: verify: checks do nothing but decide") {
  const auto inChecks = [](CycleStatement it) {
    Cycle cycle = good();
    cycle.checks = {std::move(it)};
    const auto found = verify(cycle);
    return found.empty() ? std::string() : found[0].message;
  };
  CHECK(inChecks(statement(moveX(constant(1)))) == "the checks hold a move");
  CHECK(inChecks(statement(surface())) == "the checks hold a measurement");
  CHECK(inChecks(statement(OpaqueBlock{})) == "the checks hold a block whose meaning is not known");
  CHECK(inChecks(statement(Return{})) == "the checks hold a return");
  CHECK(inChecks(statement(ProbePower{})) == "the checks hold a switch of the probe");
  CHECK(inChecks(statement(Spindle{})) == "the checks hold a switch of the spindle");
  CHECK(inChecks(statement(Coolant{})) == "the checks hold a switch of the coolant");
  CHECK(inChecks(statement(SetMode{})) == "the checks hold a change of a mode");
  CHECK(inChecks(statement(Dwell{constant(1)})) == "the checks hold a dwell");
  CHECK(inChecks(statement(Alarm{"x"})).empty());
  CHECK(inChecks(statement(Comment{"x"})).empty());
  CHECK(inChecks(statement(Assign{kLocal, constant(1)})).empty());
}
