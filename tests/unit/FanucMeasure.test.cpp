// Measurements: what a macro set wants to know, work offsets, results.
#include "FanucHelper.h"

using namespace dotek;
using namespace dotek::tests;

namespace {

ir::Measure bore(ExpressionPtr diameter, ExpressionPtr system, ExpressionPtr x, ExpressionPtr y) {
  ir::Measure out;
  out.feature = ir::Feature::Bore;
  out.diameter = std::move(diameter);
  out.setting = ir::OffsetSetting{std::move(system), {std::move(x), std::move(y), nullptr}};
  return out;
}

} // namespace

TEST_CASE("fanuc measure: travel becomes a target where the macro wants one") {
  SurfaceCycle cycle;
  Target target("inspection-plus");
  target.options.source = nullptr; // one that names no systems beyond G59
  SUBCASE("from the start, which is read") {
    const Emission out = target.emit(cycle.cycle);
    checkProgram(out);
    CHECK(out.has("#28=#5001"));
    CHECK(out.has("G65 P9811 X[#28+#24]"));
    CHECK(out.has("#[5221+[#19-54]*20]=#[5221+[#4014-54]*20]+#135-#4"));
    CHECK(out.find("G53", out.find("P9811")) < out.find("#[5221+[#19"));
    CHECK(out.has("#550=#135"));
    CHECK(out.codes().contains("result-differs"));
  }
  SUBCASE("from X-10 by 10 the word is X0, and the macro sets the offset") {
    cycle.fixAll();
    cycle.cycle.body.insert(cycle.cycle.body.begin(), statement(ir::Move{}));
    auto& move = std::get<ir::Move>(cycle.cycle.body[0].node);
    move.axes[0] = ir::Coordinate{number(-10), ir::Frame::Work, nullptr};
    const Emission out = target.emit(cycle.cycle);
    checkProgram(out);
    CHECK(out.holds("G65 P9811 S3 X0."));
    CHECK_FALSE(out.holds("+#135"));
    CHECK_FALSE(out.holds("#5241"));
  }
  SUBCASE("the same with a nominal that differs is written by the program") {
    ir::fold(cycle.cycle, {{cycle.travel, 10}, {cycle.nominal, 1}, {cycle.system, 55}});
    Target fixed("inspection-plus");
    fixed.options.fixed = {{"start_x", -10}};
    const Emission out = fixed.emit(cycle.cycle);
    checkProgram(out);
    CHECK(out.has("G65 P9811 X0."));
    CHECK(out.has("#5241=#[5221+[#4014-54]*20]+#135-1."));
  }
}

TEST_CASE("fanuc measure: a target becomes travel where the macro wants that") {
  Maker cycle;
  const VariableId x = cycle.field("x", 0);
  cycle.move(ir::Motion::Protected, ir::Axis::X, number(-10));
  cycle.surface(ir::Axis::X, use(x), number(54), use(x));
  std::get<ir::Measure>(cycle.cycle.body[1].node).target->frame = ir::Frame::Work;
  const Emission out = Target().emit(cycle.cycle);
  checkProgram(out);
  // The touch of the source ends beyond the surface by the overtravel of its macro.
  CHECK_MESSAGE(out.has("G65 P9023 S54. X[[#24+10.]*[1.+10./ABS[#24+10.]]] I#24"), out.all());
}

TEST_CASE("fanuc measure: the selector is computed where the system is an argument") {
  Maker cycle;
  const VariableId g = cycle.field("G", 56, ir::Kind::WorkOffset);
  const VariableId x = cycle.field("X", 0);
  cycle.surface(ir::Axis::X, use(x), use(g), use(x)).origin.arguments = {{'S', g}};
  std::get<ir::Measure>(cycle.cycle.body[0].node).target->frame = ir::Frame::Work;
  const Emission out = Target("inspection-plus").emit(cycle.cycle);
  checkProgram(out);
  CHECK(out.has("G65 P9811 X#24 S[#19-53]"));
  // Nothing confines G: our own alarm does.
  CHECK(out.has("IF[#19 LT 54.]THEN #3000=109(NO SUCH WORK OFFSET)"));
  CHECK(out.has("IF[#19 NE FIX[#19]]THEN #3000=109(NO SUCH WORK OFFSET)"));
}

TEST_CASE("fanuc measure: checks of the source that confine the system are not repeated") {
  const SurfaceCycle cycle;
  const Emission out = Target("inspection-plus").emit(cycle.cycle);
  CHECK_FALSE(out.holds("IF[#19 LT 54.]THEN"));
  CHECK(out.holds("IF[#19 NE FIX[#19]]THEN"));
}

TEST_CASE("fanuc measure: checks that let only such values pass as name no system in the call refuse it") {
  for (const double first : {1.0, 54.0}) {
    Maker cycle;
    const VariableId g = cycle.field("G", first + 1, ir::Kind::WorkOffset);
    const VariableId x = cycle.field("X", 0);
    // Another check fails for the defaults, before or after that of the system.
    cycle.refuseIf(ir::compare(Relation::LessEqual, use(x), number(0)), "X too small");
    cycle.refuseIf(ir::join(ir::Connective::Or, ir::compare(Relation::Less, use(g), number(first)),
                            ir::compare(Relation::Greater, use(g), number(first + 5))),
                   "The work offset");
    cycle.surface(ir::Axis::X, use(x), ir::binary(ir::BinaryOp::Add, use(g), number(53)), use(x))
        .origin.arguments = {{'S', g}};
    std::get<ir::Measure>(cycle.cycle.body[0].node).target->frame = ir::Frame::Work;
    const Emission out = Target("inspection-plus").emit(cycle.cycle);
    CAPTURE(first);
    CHECK(out.codes().contains("system-never-named") == (first > 1));
  }
}

TEST_CASE("fanuc measure: the same where the checks reject on each side in a statement of its own") {
  for (const double first : {1.0, 54.0}) {
    Maker cycle;
    const VariableId g = cycle.field("G", first + 1, ir::Kind::WorkOffset);
    const VariableId x = cycle.field("X", 0);
    cycle.refuseIf(ir::compare(Relation::Less, use(g), number(first)), "not in its list");
    cycle.refuseIf(ir::compare(Relation::Greater, use(g), number(first + 5)), "not in its list");
    cycle.surface(ir::Axis::X, use(x), ir::binary(ir::BinaryOp::Add, use(g), number(53)), use(x))
        .origin.arguments = {{'S', g}};
    std::get<ir::Measure>(cycle.cycle.body[0].node).target->frame = ir::Frame::Work;
    const Emission out = Target("inspection-plus").emit(cycle.cycle);
    CAPTURE(first);
    CHECK(out.codes().contains("system-never-named") == (first > 1));
  }
}

TEST_CASE("fanuc measure: a system in a variable of the machine is looked at after the branch has set it") {
  for (const bool set : {true, false}) {
    Maker cycle;
    const VariableId g = cycle.field("G", 56, ir::Kind::WorkOffset);
    const VariableId x = cycle.field("X", 0);
    const auto held = [] { return ir::machineVariable(number(550)); };
    if (set) cycle.add(ir::Store{number(550), use(g)});
    cycle.surface(ir::Axis::X, use(x), held(), use(x));
    std::get<ir::Measure>(cycle.cycle.body.back().node).target->frame = ir::Frame::Work;
    const Emission out = Target().emit(cycle.cycle);
    const std::string text = out.all();
    CAPTURE(text);
    const std::size_t check = text.find("IF[#550 LT 54.]"), call = text.find("P9023");
    REQUIRE(check != std::string::npos);
    REQUIRE(call != std::string::npos);
    CHECK(check < call);
    if (set) CHECK(text.find("#550=#") < check);
  }
}

TEST_CASE("fanuc measure: a bore") {
  Maker cycle;
  const VariableId d = cycle.field("d", 30), i = cycle.field("i", 30), j = cycle.field("j", 30);
  SUBCASE("EasyProbe gives the centre its coordinates") {
    cycle.add(bore(use(d), number(56), use(i), use(j))).origin.addresses = "GPDSIJ";
    const Emission out = Target().emit(cycle.cycle);
    checkProgram(out);
    CHECK(out.has("G65 P9023 D#7 S56. I#4 J#5"));
  }
  SUBCASE("Inspection Plus takes the position as the nominal") {
    cycle.move(ir::Motion::Protected, ir::Axis::X, use(i));
    cycle.move(ir::Motion::Protected, ir::Axis::Y, use(j));
    cycle.add(bore(use(d), number(56), use(i), use(j)));
    CHECK(Target("inspection-plus").emit(cycle.cycle).has("G65 P9814 D#7 S3"));
  }
  SUBCASE("else both offsets are written") {
    cycle.add(bore(use(d), number(56), use(i), use(j)));
    const Emission out = Target("inspection-plus").emit(cycle.cycle);
    checkProgram(out);
    CHECK(out.has("G65 P9814 D#7"));
    CHECK(out.has("#5261=#[5221+[#4014-54]*20]+#135-#4"));
    CHECK(out.has("#5262=#[5222+[#4014-54]*20]+#136-#5"));
  }
  SUBCASE("and along one axis only that one") {
    cycle.add(bore(use(d), number(56), use(i), nullptr));
    const Emission out = Target("inspection-plus").emit(cycle.cycle);
    CHECK(out.holds("#5261="));
    CHECK_FALSE(out.holds("#5262="));
    CHECK(Target().emit(cycle.cycle).codes().contains("needs-offset"));
  }
}

TEST_CASE("fanuc measure: writing an offset of Z asks for no shift of Z") {
  const SurfaceCycle x;
  CHECK_FALSE(Target("inspection-plus").emit(x.cycle).holds("#5043"));
  const SurfaceCycle z(ir::Axis::Z);
  Target target("inspection-plus");
  const std::string beyond = target.emit(z.cycle).all();
  CHECK(beyond.find("=7003.+20.*[#19-154.]") != std::string::npos);
  target.options.source = nullptr; // one that names no systems beyond G59
  const Emission out = target.emit(z.cycle);
  checkProgram(out);
  CHECK(out.holds("#5043"));
  CHECK(out.has("#[5223+[#19-54]*20]=#[5223+[#4014-54]*20]+#137-#6"));
}

TEST_CASE("fanuc measure: refused offsets") {
  SurfaceCycle cycle;
  SUBCASE("a control that does not tell the active system") {
    const Emission out = Target("inspection-plus", "fanuc-6m").emit(cycle.cycle);
    CHECK(out.codes().contains("offset-write-unsafe"));
  }
  SUBCASE("a rotation that no variable tells") {
    Target target("inspection-plus");
    for (stdlib::CodeInfo& code : target.control.codes)
      if (code.function == stdlib::Function::RotationOff) code.group.reset();
    CHECK(target.emit(cycle.cycle).codes().contains("offset-write-unsafe"));
  }
  SUBCASE("a system that is none") {
    ir::fold(cycle.cycle, {{cycle.system, 60}});
    CHECK(Target().emit(cycle.cycle).codes().contains("system-range"));
  }
  SUBCASE("EasyProbe measures only to set") {
    std::get<ir::Measure>(cycle.cycle.body[6].node).setting.reset();
    CHECK(Target().emit(cycle.cycle).codes().contains("needs-offset"));
    CHECK_FALSE(Target("inspection-plus").emit(cycle.cycle).codes().contains("needs-offset"));
  }
  SUBCASE("an axis that is not measured") {
    auto& measure = std::get<ir::Measure>(cycle.cycle.body[6].node);
    measure.setting->nominal[1] = number(0);
    CHECK(Target().emit(cycle.cycle).codes().contains("macro-set-cannot"));
  }
}

TEST_CASE("fanuc measure: a position that is not known") {
  Maker cycle;
  const ir::LabelId skip = cycle.cycle.addLabel({"skip", {}});
  const VariableId a = cycle.field("a", 1);
  cycle.add(ir::Branch{ir::compare(Relation::Greater, use(a), number(0)), skip});
  cycle.move(ir::Motion::Protected, ir::Axis::X, number(7));
  cycle.add(ir::Label{skip});
  cycle.surface(ir::Axis::X, number(10), number(56), number(0));
  // The control tells it where the program gets there.
  const Emission read = Target("inspection-plus").emit(cycle.cycle);
  CHECK_FALSE(read.codes().contains("start-unknown"));
  CHECK(read.has("G53"));
  CHECK(read.has("G65 P9811 X[#5041+10.]"));
  CHECK_FALSE(Target().emit(cycle.cycle).codes().contains("start-unknown"));
  // Without a variable of the position nothing does.
  Target silent("inspection-plus");
  silent.control.variables.position.reset();
  CHECK(silent.emit(cycle.cycle).codes().contains("start-unknown"));
}

TEST_CASE("fanuc measure: the start point is stale after a change of the offset") {
  Maker cycle;
  cycle.surface(ir::Axis::X, number(10), number(56), number(0));
  cycle.move(ir::Motion::Protected, ir::Axis::X, number(1), nullptr, ir::Frame::Start);
  CHECK(Target().emit(cycle.cycle).codes().contains("start-unknown"));
}

TEST_CASE("fanuc measure: results") {
  Maker cycle;
  cycle.surface(ir::Axis::X, number(10), number(56), number(0));
  SUBCASE("are copied at once") {
    cycle.add(ir::Store{number(550), ir::result(ir::ResultName::Main)});
    cycle.move(ir::Motion::Protected, ir::Axis::Z, number(5));
    CHECK(Target().emit(cycle.cycle).body() ==
          std::vector<std::string>{"G65 P9023 S56. X10. I0.", "#550=#138", "G65 P9770 Z5."});
  }
  SUBCASE("are kept in a local before the next call overwrites them") {
    cycle.move(ir::Motion::Protected, ir::Axis::Z, number(5));
    cycle.add(ir::Store{number(550), ir::result(ir::ResultName::Main)});
    CHECK(Target().emit(cycle.cycle).body() ==
          std::vector<std::string>{"G65 P9023 S56. X10. I0.", "#28=#138", "G65 P9770 Z5.", "#550=#28"});
  }
  SUBCASE("that the set does not name are refused") {
    cycle.add(ir::Store{number(550), ir::result(ir::ResultName::PositionX)});
    CHECK(Target().emit(cycle.cycle).codes().contains("result-unknown"));
    CHECK(Target("inspection-plus").emit(cycle.cycle).has("#550=#135"));
  }
}

TEST_CASE("fanuc measure: a result after a copied block is not that of the call before it") {
  const auto emitted = [](bool block) {
    Maker cycle;
    cycle.surface(ir::Axis::X, number(10), number(56), number(0));
    if (block) cycle.add(ir::OpaqueBlock{{{'M', number(77), {}}}});
    cycle.add(ir::Store{number(550), ir::result(ir::ResultName::Main)});
    return Target("inspection-plus").emit(cycle.cycle);
  };
  CHECK(emitted(false).has("#550=#135"));
  CHECK(emitted(true).codes().contains("result-unknown"));
}

TEST_CASE("fanuc measure: where values may be stored") {
  const auto codes = [](double variable, bool calls) {
    std::set<std::string> out;
    const auto store = [&](Maker& cycle) {
      cycle.add(ir::Store{number(variable), number(1)});
      for (const std::string& code : Target("inspection-plus").emit(cycle.cycle).codes())
        if (code.starts_with("store-")) out.insert(code);
    };
    SurfaceCycle measuring;
    Maker alone;
    store(calls ? measuring : alone);
    return out;
  };
  CHECK(codes(600, true).empty());
  CHECK(codes(5, true) == std::set<std::string>{"store-variable"});
  // A work offset is one on both controls.
  CHECK(codes(5221, true).empty());
  CHECK(codes(510, true) == std::set<std::string>{"store-calibration"});
  CHECK(codes(140, true) == std::set<std::string>{"store-scratch"});
  // Where no macro is called, what it works in is like any other variable; what it keeps is not.
  CHECK(codes(510, false) == std::set<std::string>{"store-calibration-uncalled"});
  CHECK(codes(140, false).empty());
  Maker switching;
  switching.add(ir::ProbePower{true});
  switching.add(ir::Store{number(140), number(1)});
  CHECK(Target("inspection-plus").emit(switching.cycle).codes().contains("store-scratch"));
  // What switches the probe, or skips by itself, reads no calibration.
  switching.add(ir::Store{number(510), number(1)});
  switching.add(ir::OpaqueBlock{{{'G', number(31), {}}, {'Z', number(-1), {}}, {'F', number(100), {}}}});
  CHECK(Target("inspection-plus").emit(switching.cycle).codes().contains("store-calibration-uncalled"));
  switching.add(ir::OpaqueBlock{{{'G', number(65), {}}, {'P', number(9100), {}}}});
  CHECK(Target("inspection-plus").emit(switching.cycle).codes().contains("store-calibration"));
  Maker computed;
  computed.add(ir::Store{use(computed.field("n", 600)), number(1)});
  CHECK(Target().emit(computed.cycle).codes() == std::set<std::string>{"machine-variable-refused"});
  // Modal codes are read only.
  Maker modal;
  modal.add(ir::Store{number(4001), number(1)});
  CHECK(Target().emit(modal.cycle).codes() == std::set<std::string>{"variable-read-only"});
}

TEST_CASE("fanuc measure: where a computed number may lead") {
  const auto codes = [](double base, ir::BinaryOp op) {
    SurfaceCycle cycle;
    cycle.add(ir::Store{ir::binary(op, number(base), ir::machineVariable(number(601))), number(1)});
    std::set<std::string> out;
    for (const std::string& code : Target("inspection-plus").emit(cycle.cycle).codes())
      if (code.starts_with("store-") || code == "machine-variable-refused") out.insert(code);
    return out;
  };
  CHECK(codes(600, ir::BinaryOp::Add).empty());
  CHECK(codes(115, ir::BinaryOp::Add) == std::set<std::string>{"store-reaches-scratch"});
  CHECK(codes(500, ir::BinaryOp::Add) == std::set<std::string>{"store-reaches-scratch"});
  // Taken off, it may reach the arguments of the program itself.
  CHECK(codes(600, ir::BinaryOp::Subtract) == std::set<std::string>{"machine-variable-refused"});
}

TEST_CASE("fanuc measure: variables of the machine that a source reads") {
  const auto codes = [](double variable, std::string_view control) {
    Maker cycle;
    cycle.add(ir::Store{number(550), ir::machineVariable(number(variable))});
    return Target("easyprobe", control).emit(cycle.cycle).codes();
  };
  CHECK(codes(551, "fanuc-31i-b").empty());
  CHECK(codes(5041, "fanuc-0i-md").empty());
  CHECK(codes(5041, "fanuc-31i-b").empty());
  CHECK(codes(24, "fanuc-0i-md") == std::set<std::string>{"machine-variable-refused"});
}

TEST_CASE("fanuc measure: what the set has no call for") {
  SurfaceCycle cycle;
  Target target;
  std::erase_if(target.macros.signatures,
                [](const stdlib::MacroSignature& s) { return s.intent == stdlib::Intent::Surface; });
  CHECK(target.emit(cycle.cycle).codes().contains("macro-set-cannot"));
  Target needs;
  for (stdlib::MacroSignature& signature : needs.macros.signatures)
    for (stdlib::MacroArgument& argument : signature.arguments)
      if (argument.role == stdlib::ArgumentRole::Feed) argument.required = true;
  CHECK(needs.emit(cycle.cycle).codes().contains("macro-argument-missing"));
}
