// Numbers and expressions that the Fanuc back end writes.
#include "FanucHelper.h"

using namespace dotek;
using namespace dotek::tests;

namespace {

// A rapid move of Z to the value; D, E, F are the fields d, e, f with locals #7, #8, #9.
struct Value : Maker {
  VariableId d, e, f;
  Value() {
    d = field("d", 1);
    e = field("e", 1);
    f = field("f", 1);
  }
  Emission emit(const ExpressionPtr& value, std::string_view control = "fanuc-0i-md") {
    move(ir::Motion::Rapid, ir::Axis::Z, value);
    return Target("easyprobe", control).emit(cycle);
  }
  // The blocks, one after the other.
  std::string text(const ExpressionPtr& value, std::string_view control = "fanuc-0i-md") {
    const Emission out = emit(value, control);
    if (!out.lines) return out.all();
    checkProgram(out);
    std::string all;
    for (const std::string& line : out.body())
      all += (all.empty() ? "" : "; ") + line;
    return all;
  }
};

ExpressionPtr apply(UnaryOp op, ExpressionPtr value) {
  return ir::unary(op, std::move(value));
}
ExpressionPtr times(ExpressionPtr a, ExpressionPtr b) {
  return ir::binary(BinaryOp::Multiply, std::move(a), std::move(b));
}

} // namespace

TEST_CASE("fanuc values: constants have a point") {
  CHECK(Value().text(number(5)) == "G0 Z5.");
  CHECK(Value().text(number(-0.5)) == "G0 Z-0.5");
  CHECK(Value().text(number(0)) == "G0 Z0.");
  CHECK(Value().text(number(-0.0)) == "G0 Z0.");
  CHECK(Value().text(number(0.1 + 0.2)) == "G0 Z0.3");
}

TEST_CASE("fanuc values: digits that do not fit") {
  Value rounded;
  const Emission out = rounded.emit(number(1.23456));
  CHECK(out.has("G0 Z1.235"));
  REQUIRE(out.codes() == std::set<std::string>{"number-rounded"});
  CHECK(out.diagnostics.all()[0].message.find("1.23456") != std::string::npos);
  CHECK(out.diagnostics.all()[0].message.find("1.235") != std::string::npos);
  CHECK(Value().emit(number(-0.0001)).has("G0 Z0."));
  CHECK(Value().emit(number(100000)).codes() == std::set<std::string>{"number-too-large"});
  CHECK(Value().emit(number(99999.9996)).codes().contains("number-too-large"));
}

TEST_CASE("fanuc values: signs and brackets") {
  Value v;
  const auto d = use(v.d), e = use(v.e), f = use(v.f);
  const auto text = [](const ExpressionPtr& value) { return Value().text(value); };
  CHECK(text(d) == "G0 Z#7");
  CHECK(text(apply(UnaryOp::Negate, d)) == "G0 Z-#7");
  CHECK(text(plus(d, e)) == "G0 Z[#7+#8]");
  CHECK(text(plus(d, number(-5))) == "G0 Z[#7-5.]");
  CHECK(text(minus(d, number(-5))) == "G0 Z[#7+5.]");
  CHECK(text(minus(d, minus(e, f))) == "G0 Z[#7-[#8-#9]]");
  CHECK(text(minus(minus(d, e), f)) == "G0 Z[#7-#8-#9]");
  CHECK(text(times(plus(d, e), f)) == "G0 Z[[#7+#8]*#9]");
  CHECK(text(times(d, number(-2))) == "G0 Z[#7*[-2.]]");
  CHECK(text(times(d, apply(UnaryOp::Negate, e))) == "G0 Z[#7*[-#8]]");
  CHECK(text(apply(UnaryOp::Negate, plus(d, e))) == "G0 Z[0.-[#7+#8]]");
  CHECK(text(apply(UnaryOp::Absolute, minus(d, e))) == "G0 Z[ABS[#7-#8]]");
  CHECK(text(ir::binary(BinaryOp::Divide, d, times(e, f))) == "G0 Z[#7/[#8*#9]]");
  CHECK(text(minus(plus(d, e), d)) == "G0 Z#8");
  CHECK(text(plus(plus(d, number(10)), number(-10))) == "G0 Z#7");
}

TEST_CASE("fanuc values: functions of the control") {
  Value v;
  const auto d = use(v.d), e = use(v.e);
  CHECK(Value().text(apply(UnaryOp::Truncate, d)) == "G0 Z[FIX[#7]]");
  CHECK(Value().text(apply(UnaryOp::RoundUp, d)) == "G0 Z[FUP[#7]]");
  CHECK(Value().text(apply(UnaryOp::SquareRoot, d)) == "G0 Z[SQRT[#7]]");
  CHECK(Value().text(apply(UnaryOp::ArcTangent, d)) == "G0 Z[ATAN[#7]]");
  // After an address ROUND would round to the increment.
  CHECK(Value().text(apply(UnaryOp::Round, d)) == "#28=ROUND[#7]; G0 Z#28");
  CHECK(Value().emit(apply(UnaryOp::ArcSine, d), "fanuc-6m").codes().contains("function-missing"));
  CHECK(Value().emit(ir::binary(BinaryOp::Modulo, d, e)).codes().contains("function-missing"));
  CHECK(Value()
            .emit(ir::binary(BinaryOp::Modulo, d, e), "fanuc-31i-b")
            .codes()
            .contains("modulo-of-fractions"));
  // Whichever half turn the control's parameter counts.
  CHECK(Value().text(ir::binary(BinaryOp::Direction, d, e)) ==
        "#28=ATAN[#8]/[#7]; IF[#28 LE 180.]GOTO 10; #28=#28-360.; N10 G0 Z#28");
  CHECK(Value().emit(ir::binary(BinaryOp::Direction, d, e), "fanuc-6m").codes().contains("function-missing"));
}

TEST_CASE("fanuc values: null") {
  Value v;
  const VariableId maybe = v.field("e2", 1);
  v.cycle.variables[maybe].optional = true;
  v.cycle.variables[maybe].defaultValue.reset();
  CHECK(v.text(ir::binary(BinaryOp::ValueOr, use(maybe), number(3))) ==
        "#27=#1; IF[#27 NE #0]GOTO 10; #27=3.; N10 #28=#27; G0 Z#28");
  Value w;
  const VariableId other = w.field("e2", 1);
  w.cycle.variables[other].optional = true;
  CHECK(w.text(apply(UnaryOp::NullAsZero, use(other))) == "G0 Z[#1+0.]");
  CHECK_FALSE(w.emit(number(1)).holds("ARGUMENT A MISSING"));
}

TEST_CASE("fanuc values: brackets beyond the control's depth go to a helper") {
  Value v;
  ExpressionPtr deep = use(v.d);
  for (int i = 0; i < 8; ++i)
    deep = apply(UnaryOp::Absolute, minus(use(v.e), deep));
  const Emission out = v.emit(deep);
  checkProgram(out, 5);
  const auto body = out.body();
  REQUIRE(body.size() == 2);
  CHECK(body[0].starts_with("#28="));
  CHECK(body[1].find("#28") != std::string::npos);
  // Both together are the expression: eight times ABS.
  std::size_t count = 0;
  for (const std::string& line : body)
    for (std::size_t at = line.find("ABS["); at != std::string::npos; at = line.find("ABS[", at + 1))
      ++count;
  CHECK(count == 8);
}

TEST_CASE("fanuc values: no local is left") {
  Value v;
  ExpressionPtr sum = number(0);
  for (int i = 0; i < 40; ++i) {
    const VariableId id = v.cycle.add(local("l" + std::to_string(i)));
    v.add(ir::Assign{id, number(i)});
    sum = plus(sum, use(id));
  }
  CHECK(v.emit(sum).codes() == std::set<std::string>{"too-many-locals"});
  // All letters and 7 own locals: 5 modes leave none for a helper.
  Maker full;
  ExpressionPtr deep = number(1);
  for (int i = 0; i < 21; ++i)
    deep = plus(deep, use(full.field("field" + std::to_string(i), 0)));
  for (int i = 0; i < 7; ++i)
    full.add(ir::Assign{full.cycle.add(local("l" + std::to_string(i))), number(i)});
  full.move(ir::Motion::Rapid, ir::Axis::Z, apply(UnaryOp::Round, deep));
  CHECK(Target().emit(full.cycle).codes() == std::set<std::string>{"expression-depth"});
}

TEST_CASE("fanuc values: selectors are whole") {
  Maker v;
  v.add(ir::SetMode{ir::Mode::WorkSystem, number(55)});
  CHECK(Target().emit(v.cycle).has("G55"));
  Maker w;
  w.add(ir::Spindle{ir::Spindle::State::Clockwise, number(100.5)});
  CHECK(Target().emit(w.cycle).codes() == std::set<std::string>{"selector-fraction"});
  Maker x;
  x.add(ir::SetMode{ir::Mode::WorkSystem, number(60)});
  CHECK(Target().emit(x.cycle).codes() == std::set<std::string>{"system-range"});
}
