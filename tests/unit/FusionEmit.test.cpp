// Fragments of cycles that no front end makes today: what the back end says by itself.
#include "FusionHelper.h"
#include "backends/fusion/Emit.h"
#include "backends/fusion/Script.h"
#include "ir/Evaluate.h"
#include "support/Picture.h"

using namespace dotek;
using namespace dotek::tests;
namespace fusion = backends::fusion;

namespace {

// One field `A` that the block `G4 X` prints.
struct Built {
  stdlib::Control control;
  stdlib::MacroSet macros;
  ir::Cycle cycle;
  std::vector<ir::PrintedBlock> printed;
  Diagnostics diagnostics;

  Built() {
    control.integerDigits = 5;
    macros.title = "no set";
    cycle.name = "built";
    add("A", ir::Role::Parameter);
    ir::PrintedBlock block;
    block.numbered = true;
    ir::PrintedPiece text, value;
    text.text = "G4 X";
    value.picture = std::get<Picture>(Picture::parse("####.###;0"));
    block.pieces = {text, value};
    printed.push_back(block);
  }
  ir::VariableId add(const std::string& name, ir::Role role) {
    ir::Variable variable;
    variable.name = name;
    variable.role = role;
    if (role == ir::Role::Parameter) variable.defaultValue = 1;
    return cycle.add(std::move(variable));
  }
  void check(ir::ConditionPtr condition, const std::string& message) {
    const ir::LabelId label = cycle.addLabel({"next", {}});
    cycle.checks.push_back({ir::Branch{ir::negate(condition), label}, {}});
    cycle.checks.push_back({ir::Alarm{message}, {}});
    cycle.checks.push_back({ir::Label{label}, {}});
  }
  void assign(ir::VariableId id, ir::ExpressionPtr value) {
    cycle.checks.push_back({ir::Assign{id, std::move(value)}, {}});
  }
  std::string emit() {
    const fusion::EmitOptions options{control, macros, false, printed, {}, {}, {}, {}};
    std::string out;
    if (const auto lines = fusion::emit(cycle, options, diagnostics))
      for (const auto& line : *lines)
        out += line.text + "\n";
    return out;
  }
  bool says(const std::string& code) const {
    return std::any_of(diagnostics.all().begin(), diagnostics.all().end(),
                       [&](const Diagnostic& one) { return one.code == code; });
  }
  // "printed", or the first error.
  std::string run(double value, const fusion::RunInput& given = {}) {
    const std::string fragment = emit();
    REQUIRE_MESSAGE(!fragment.empty(), renderText(diagnostics, SourceMap(), 5));
    fusion::RunInput input = given;
    input.properties["built_A"] = value;
    const fusion::RunResult result = runFragment(fragment, "built", input);
    REQUIRE_MESSAGE(!result.fault, faultOf(result));
    return result.errors.empty() ? "printed" : result.errors.front();
  }
};

ir::ExpressionPtr number(double value) {
  return ir::constant(value);
}

} // namespace

TEST_CASE("names of a fragment") {
  CHECK(fusion::prefixOf("surface-x") == "surfaceX");
  CHECK(fusion::prefixOf("A.B.C2") == "aBC2");
  CHECK(fusion::prefixOf("3 axes") == "cycle3Axes");
  CHECK(fusion::prefixOf("\xC4\x8C") == "cycle");
  CHECK(fusion::isReserved("class"));
  CHECK_FALSE(fusion::isReserved("klass"));
  fusion::LocalNames names;
  CHECK(names.take("a") == "a");
  CHECK(names.take("a") == "a_");
  CHECK(names.take("x") == "x_");
  CHECK(names.take("new") == "new_");
  CHECK(names.take("1 b") == "_1_b");
}

TEST_CASE("literals of a fragment") {
  CHECK(fusion::quoted("a\"b\\c\n\xC5\x98\xF0\x9F\x98\x80") == R"("a\"b\\c\u000A\u0158\uD83D\uDE00")");
  CHECK(evaluated(fusion::quoted("a\"b\\c\xC5\x98")) == "a\"b\\c\xC5\x98");
  CHECK(fusion::numberLiteral(-0.5) == "-0.5");
  CHECK(fusion::numberLiteral(-0.5, true) == "(-0.5)");
}

TEST_CASE("what a control alone knows is refused in a formula") {
  Built machine;
  machine.assign(machine.add("L", ir::Role::Local), ir::machineVariable(number(500)));
  CHECK(machine.emit().empty());
  CHECK(machine.says("fusion-run-time"));
}

TEST_CASE("a host input that no post knows is asked for") {
  Built host;
  const ir::VariableId feed = host.add("return_feed", ir::Role::Host);
  host.check(ir::compare(ir::Relation::Less, ir::variable(feed), number(1)), "slow");
  CHECK(host.emit().empty());
  CHECK(host.says("host-not-in-post"));
}

TEST_CASE("two fields of one property are refused") {
  Built twice;
  twice.add("B!", ir::Role::Parameter);
  twice.add("B?", ir::Role::Parameter);
  CHECK(twice.emit().empty());
  CHECK(twice.says("property-twice"));
}

TEST_CASE("arithmetic without a result is an error before it is used") {
  Built inverse;
  const ir::ExpressionPtr a = ir::variable(0);
  // 1/(1/A): 0 again where A is 0, as JavaScript counts.
  const ir::ExpressionPtr value =
      ir::binary(ir::BinaryOp::Divide, number(1), ir::binary(ir::BinaryOp::Divide, number(1), a));
  inverse.check(ir::compare(ir::Relation::Greater, value, number(5)), "too large");
  CHECK(inverse.run(4) == "printed");
  CHECK(inverse.run(6) == "too large");
  CHECK(inverse.run(0) == "built: a formula has no result for these values");

  Built root;
  root.check(ir::compare(ir::Relation::Greater, ir::unary(ir::UnaryOp::SquareRoot, a), number(2)), "wide");
  CHECK(root.run(4) == "printed");
  CHECK(root.run(5) == "wide");
  CHECK(root.run(-1) == "built: a formula has no result for these values");

  Built junction;
  const ir::ConditionPtr partial = ir::compare(ir::Relation::Greater, value, number(5));
  junction.check(ir::join(ir::Connective::Or, partial, ir::compare(ir::Relation::Less, a, number(0))), "no");
  CHECK(junction.emit().empty());
  CHECK(junction.says("fusion-arithmetic"));
}

TEST_CASE("operators of a fragment give what the IR gives") {
  const ir::ExpressionPtr a = ir::variable(0);
  const auto unary = [&](ir::UnaryOp op) { return ir::unary(op, a); };
  const auto binary = [&](ir::BinaryOp op, double right) { return ir::binary(op, a, number(right)); };
  const ir::ExpressionPtr values[] = {
      unary(ir::UnaryOp::Negate),
      unary(ir::UnaryOp::Absolute),
      unary(ir::UnaryOp::Truncate),
      unary(ir::UnaryOp::RoundUp),
      unary(ir::UnaryOp::Round),
      unary(ir::UnaryOp::SquareRoot),
      unary(ir::UnaryOp::Sine),
      unary(ir::UnaryOp::Cosine),
      unary(ir::UnaryOp::Tangent),
      unary(ir::UnaryOp::ArcSine),
      unary(ir::UnaryOp::ArcCosine),
      unary(ir::UnaryOp::ArcTangent),
      unary(ir::UnaryOp::Logarithm),
      unary(ir::UnaryOp::Exponential),
      binary(ir::BinaryOp::Add, 0.1),
      binary(ir::BinaryOp::Subtract, -7),
      binary(ir::BinaryOp::Multiply, -3),
      binary(ir::BinaryOp::Divide, 7),
      binary(ir::BinaryOp::Modulo, 7),
      binary(ir::BinaryOp::Direction, -2),
      binary(ir::BinaryOp::BitAnd, 6),
      binary(ir::BinaryOp::BitOr, 6),
      binary(ir::BinaryOp::BitXor, 6),
      ir::unary(ir::UnaryOp::Negate, binary(ir::BinaryOp::Subtract, 5)),
      ir::binary(ir::BinaryOp::Subtract, number(1), binary(ir::BinaryOp::Subtract, 5))};
  for (const ir::ExpressionPtr& value : values) {
    Built built;
    const ir::VariableId copy = built.add("L", ir::Role::Local);
    const ir::VariableId wanted = built.add("W", ir::Role::Parameter);
    built.assign(copy, value);
    const ir::ExpressionPtr away = ir::unary(
        ir::UnaryOp::Absolute, ir::binary(ir::BinaryOp::Subtract, ir::variable(copy), ir::variable(wanted)));
    built.check(ir::compare(ir::Relation::Greater, away, number(1e-9)), "another value");
    for (const double given :
         {0.0, 0.5, -0.5, 1.5, -1.5, 2.5, 3.0, -8.0, 45.0, 90.0, 180.0, -270.0, 100.25}) {
      ir::Environment environment(built.cycle.variables.size());
      environment[0] = ir::Scalar::of(given);
      const ir::Scalar expected = ir::evaluate(*value, environment);
      fusion::RunInput input;
      input.properties["built_W"] = expected.known() ? expected.value : 0;
      const std::string found = built.run(given, input);
      CHECK_MESSAGE(found ==
                        (expected.known() ? "printed" : "built: a formula has no result for these values"),
                    given << " gives " << expected.value);
    }
  }
}
