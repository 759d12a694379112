// The text form of the IR.
#include "ir/Print.h"
#include "tests/unit/IrHelper.h"

#include <doctest/doctest.h>

using namespace dotek;
using namespace dotek::ir;
using namespace dotek::tests;

namespace {

Cycle two() {
  Cycle cycle;
  cycle.add(parameter("a"));
  cycle.add(parameter("b c"));
  return cycle;
}

std::string text(const ExpressionPtr& expression) {
  return print(*expression, two());
}

std::string text(const ConditionPtr& condition) {
  return print(*condition, two());
}

const ExpressionPtr kA = variable(0);
const ExpressionPtr kB = variable(1);

ExpressionPtr number(double value, std::string digits) {
  return constant(value, {}, std::move(digits));
}

} // namespace

TEST_CASE("ir: brackets follow the tree") {
  const auto five = number(5, "5");
  const auto sum = binary(BinaryOp::Add, kA, five);
  CHECK(text(sum) == "a + 5");
  CHECK(text(binary(BinaryOp::Add, sum, kB)) == "a + 5 + \"b c\"");
  CHECK(text(binary(BinaryOp::Add, kB, sum)) == "\"b c\" + (a + 5)");
  CHECK(text(binary(BinaryOp::Subtract, kA, sum)) == "a - (a + 5)");
  CHECK(text(binary(BinaryOp::Multiply, sum, kA)) == "(a + 5) * a");
  CHECK(text(binary(BinaryOp::Divide, kA, binary(BinaryOp::Multiply, kA, five))) == "a / (a * 5)");
  CHECK(text(binary(BinaryOp::Modulo, kA, five)) == "a mod 5");
  CHECK(text(unary(UnaryOp::Negate, kA)) == "-a");
  CHECK(text(unary(UnaryOp::Negate, sum)) == "-(a + 5)");
  CHECK(text(unary(UnaryOp::Negate, five)) == "-(5)"); // -5 is a constant
  CHECK(text(unary(UnaryOp::NullAsZero, kA)) == "or_zero(a)");
  CHECK(text(binary(BinaryOp::ValueOr, kA, nullValue())) == "value_or(a, null)");
  CHECK(text(binary(BinaryOp::Direction, kA, sum)) == "direction(a, a + 5)");
  CHECK(text(machineVariable(number(550, "550"))) == "#550");
  CHECK(text(machineVariable(kA)) == "#a");
  CHECK(text(machineVariable(sum)) == "#(a + 5)");
  CHECK(text(result(ResultName::PositionX)) == "result x");
}

TEST_CASE("ir: numbers show what the source writes") {
  CHECK(text(number(5, "5.")) == "5.");
  CHECK(text(number(-0.5, "-.5")) == "-.5");
  CHECK(text(constant(5)) == "{5}"); // computed
  CHECK(text(number(0.005, "5")) == "0.005 written \"5\"");
  CHECK(text(machineVariable(constant(5))) == "#{5}");
  CHECK(text(machineVariable(constant(-5, {}, "-5"))) == "#(-5)");
}

TEST_CASE("ir: conditions") {
  const auto less = compare(Relation::Less, kA, number(1, "1"));
  const auto null = isNull(kA);
  const auto no = std::make_shared<const Condition>(Condition{{}, Not{null}});
  CHECK(text(less) == "a < 1");
  CHECK(text(negate(less)) == "a >= 1");
  CHECK(text(compare(Relation::NotEqual, kA, kB)) == "a <> \"b c\"");
  CHECK(text(null) == "a is null");
  CHECK(text(negate(null)) == "a is not null");
  CHECK(text(ConditionPtr(std::make_shared<const Condition>(Condition{{}, Not{less}}))) == "not (a < 1)");
  const auto both = join(Connective::And, less, null);
  const auto either = join(Connective::Or, less, null);
  CHECK(text(both) == "a < 1 and a is null");
  CHECK(text(join(Connective::And, either, both)) == "(a < 1 or a is null) and (a < 1 and a is null)");
  CHECK(text(join(Connective::Or, both, either)) == "a < 1 and a is null or (a < 1 or a is null)");
  CHECK(text(truth(false)) == "false");
}

TEST_CASE("ir: names") {
  Cycle cycle;
  for (const char* name : {"a", "a", "a_2", "move", "x1", "1x", "č", "say \"x\"\n", ""})
    cycle.add(local(name));
  const auto name = [&](VariableId id) { return print(*variable(id), cycle); };
  CHECK(name(0) == "a");
  CHECK(name(1) == "a_3"); // a_2 is somebody's name
  CHECK(name(2) == "a_2");
  CHECK(name(3) == "\"move\"");
  CHECK(name(4) == "x1");
  CHECK(name(5) == "\"1x\"");
  CHECK(name(6) == "\"č\"");
  CHECK(name(7) == "\"say \\\"x\\\"\\x0A\"");
  CHECK(name(8) == "\"\"");
  CHECK(name(99) == "\"?\"");
}

TEST_CASE("ir: a module as text") {
  SourceMap sources;
  const FileId file = sources.add(SourceFile("Prog.txt", "one\ntwo\nthree\n", Encoding::Utf8));
  Module module;
  Cycle cycle;
  cycle.name = "SURFACE.Z";
  cycle.title = "One surface";
  Variable depth = parameter("Zb", Kind::Length);
  depth.unit = "mm";
  depth.optional = true;
  depth.defaultValue = 50;
  depth.defaultDigits = "50";
  depth.meaning = "Z of the surface";
  depth.range = {file, 4, 6};
  const auto zb = variable(cycle.add(depth));
  const auto g = variable(cycle.add(parameter("G", Kind::WorkOffset)));
  const auto clearance = variable(cycle.add(named("clearance", Role::Host, Kind::Length)));
  const VariableId code = cycle.add(local("icode"));
  const LabelId wrong = cycle.addLabel({"wrong", {}});
  const LabelId end = cycle.addLabel({"end", {}});
  cycle.checks = {statement(Branch{compare(Relation::Less, g, number(54, "54")), wrong}),
                  statement(Jump{end}),
                  statement(Label{wrong}),
                  statement(Alarm{"G is 54 to 59"}),
                  statement(Label{end}),
                  statement(Assign{code, constant(1)}),
                  statement(Return{})};
  Move down;
  down.motion = Motion::Protected;
  down.axes[0] = Coordinate{zb, Frame::Start, nullptr};
  down.axes[2] = Coordinate{clearance, Frame::Work, g};
  down.feed = number(1000, "1000");
  down.point = ProbePoint::Lowest;
  Measure touch;
  touch.axis = Axis::Z;
  touch.target = Coordinate{unary(UnaryOp::Negate, zb), Frame::Here, nullptr};
  touch.setting = OffsetSetting{g, {nullptr, nullptr, zb}};
  Measure bore;
  bore.feature = Feature::Bore;
  bore.diameter = zb;
  bore.setting = OffsetSetting{g, {zb, zb, nullptr}};
  CycleStatement placed = statement(down);
  placed.origin.ranges = {{file, 8, 9}};
  placed.origin.reason = "argument omitted";
  cycle.body = {
      std::move(placed),
      statement(touch),
      statement(bore),
      statement(Store{number(550, "550"), result(ResultName::Main)}),
      statement(ProbePower{true}),
      statement(Spindle{Spindle::State::Clockwise, number(500, "500")}),
      statement(Coolant{Coolant::State::Mist}),
      statement(SetMode{Mode::WorkSystem, g}),
      statement(SetMode{Mode::Absolute, nullptr}),
      statement(Dwell{constant(0.5)}),
      statement(Stop{true, "look"}),
      statement(Comment{"(over)"}),
      statement(OpaqueBlock{{Word{'M', number(77, "77"), {}}, Word{'X', zb, {}}, Word{'Y', nullptr, {}}}})};
  module.cycles.push_back(cycle);
  CHECK(print(module, &sources) == R"cyc(units mm

cycle "SURFACE.Z" "One surface"
  parameter Zb length in mm optional = 50 "Z of the surface" ; Prog.txt:2
  parameter G work-offset
  host clearance length
  local icode number
  checks
    if G < 54 goto wrong
    goto end
  label wrong
    alarm "G is 54 to 59"
  label end
    set icode = {1}
    return
  body
    move protected x = start Zb, z = work of G: clearance feed 1000 point lowest ; Prog.txt:3, argument omitted
    measure surface z to here -Zb, set system G: z = Zb
    measure bore diameter Zb, set system G: x = Zb, y = Zb
    store #550 = result main
    probe on
    spindle clockwise speed 500
    coolant mist
    mode work-system G
    mode absolute
    dwell {0.5}
    stop optional "look"
    comment "(over)"
    block M77 X(Zb) Y
)cyc");

  module.sourceUnit = LengthUnit::Inch;
  module.cycles[0].measurementStated = false;
  module.cycles[0].body.clear();
  module.cycles[0].checks.clear();
  CHECK(print(module, nullptr) == R"cyc(units inch

cycle "SURFACE.Z" "One surface"
  measurement not stated
  parameter Zb length in mm optional = 50 "Z of the surface"
  parameter G work-offset
  host clearance length
  local icode number
  labels wrong end
  checks
  body
)cyc");
}

TEST_CASE("ir: two variables of one name keep apart") {
  Module module;
  Cycle cycle;
  cycle.name = "C";
  cycle.add(parameter("a"));
  cycle.add(local("a"));
  cycle.body = {statement(Assign{1, variable(0)})};
  module.cycles.push_back(cycle);
  CHECK(print(module, nullptr).find("local a as a_2 number\n") != std::string::npos);
  CHECK(print(module, nullptr).find("set a_2 = a\n") != std::string::npos);
}
