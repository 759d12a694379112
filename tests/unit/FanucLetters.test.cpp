// Letters of arguments: docs/convert.md, "Letters".
#include "FanucHelper.h"

using namespace dotek;
using namespace dotek::tests;
using backends::fanuc::Argument;

namespace {

struct Letters {
  std::string text; // "a=X G=S": name and letter, in the order of the result
  std::set<std::string> codes;
  std::vector<Argument> arguments;
};

Letters letters(const ir::Cycle& cycle, const std::map<std::string, char>& given = {}) {
  Target target;
  target.options.letters = given;
  Diagnostics diagnostics;
  Letters out;
  if (const auto all = backends::fanuc::assignLetters(cycle, target.options, diagnostics)) {
    out.arguments = *all;
    for (const Argument& argument : *all)
      out.text +=
          (out.text.empty() ? "" : " ") + cycle.variable(argument.variable).name + "=" + argument.letter;
  }
  for (const Diagnostic& d : diagnostics.all())
    out.codes.emplace(d.code);
  return out;
}

// A cycle that uses its fields in one sum, so that none fills an argument.
Maker used(const std::vector<std::string>& names) {
  Maker out;
  ExpressionPtr sum = number(0);
  for (const std::string& name : names)
    sum = plus(sum, use(out.field(name, 0)));
  out.move(ir::Motion::Rapid, ir::Axis::Z, sum);
  return out;
}

} // namespace

TEST_CASE("fanuc letters: arguments of the source, own names, the list") {
  const SurfaceCycle cycle;
  CHECK(letters(cycle.cycle).text == "a=X I=I G=S Zb=A Z=Z clearance=B tool_radius=C");
}

TEST_CASE("fanuc letters: argument specification I") {
  const auto all = letters(used({"A", "B", "C", "I", "J", "K", "D", "E", "F", "H", "M",
                                 "Q", "R", "S", "T", "U", "V", "W", "X", "Y", "Z"})
                               .cycle);
  std::string locals;
  for (const Argument& argument : all.arguments)
    locals += std::to_string(argument.local) + " ";
  CHECK(locals == "1 2 3 4 5 6 7 8 9 11 13 17 18 19 20 21 22 23 24 25 26 ");
}

TEST_CASE("fanuc letters: the first in the source wins, and illegal letters are not taken") {
  Maker cycle = used({"p", "g", "x"});
  cycle.cycle.body[0].origin.arguments = {{'P', 0}, {'X', 1}, {'X', 2}};
  // p: P is never an argument; g: fills X first; x: its own letter is gone.
  const Letters out = letters(cycle.cycle);
  CHECK(out.text == "p=A g=X x=B");
  CHECK(out.codes == std::set<std::string>{"letter-of-other-field"});
}

TEST_CASE("fanuc letters: --arg") {
  const Maker cycle = used({"depth", "width"});
  CHECK(letters(cycle.cycle, {{"width", 'a'}}).text == "depth=B width=A");
  CHECK(letters(cycle.cycle, {{"width", 'N'}}).codes == std::set<std::string>{"letter-not-allowed"});
  CHECK(letters(cycle.cycle, {{"width", 'Q'}, {"depth", 'Q'}}).codes ==
        std::set<std::string>{"letter-twice"});
  Target target;
  target.options.letters = {{"widht", 'Q'}};
  Diagnostics diagnostics;
  CHECK_FALSE(backends::fanuc::assignLetters(cycle.cycle, target.options, diagnostics));
  REQUIRE(diagnostics.all().size() == 1);
  CHECK(diagnostics.all()[0].code == "argument-unknown");
  CHECK(diagnostics.all()[0].message.find("`width`") != std::string::npos);
}

TEST_CASE("fanuc letters: more names than letters") {
  std::vector<std::string> names;
  for (int i = 0; i < 22; ++i)
    names.push_back("field" + std::to_string(i));
  const Maker cycle = used(names);
  Diagnostics diagnostics;
  const Target target;
  CHECK_FALSE(backends::fanuc::assignLetters(cycle.cycle, target.options, diagnostics));
  REQUIRE(diagnostics.all().size() == 1);
  CHECK(diagnostics.all()[0].code == "too-many-arguments");
  CHECK(diagnostics.all()[0].message.find("`field0`, `field1`") != std::string::npos);
  CHECK(diagnostics.all()[0].message.find("`field21`") != std::string::npos);
}

TEST_CASE("fanuc letters: what the cycle does not use needs none, nor does a start that is read") {
  Maker cycle = used({"depth"});
  cycle.field("spare", 1);
  const VariableId start = cycle.host("start_x");
  cycle.move(ir::Motion::Rapid, ir::Axis::X, use(start));
  CHECK(letters(cycle.cycle).text == "depth=A");
  const Emission out = Target().emit(cycle.cycle);
  CHECK(out.has("#28=#5001"));
  CHECK(out.has("G0 X#28"));
}

TEST_CASE("fanuc letters: I, J, K are in order in every call") {
  Maker cycle;
  const VariableId k = cycle.field("K", 1), j = cycle.field("J", 2), i = cycle.field("I", 3);
  cycle.move(ir::Motion::Rapid, ir::Axis::Z, plus(use(k), plus(use(j), use(i))));
  CHECK(Target().emit(cycle.cycle).has("(CALL: G65 P8000 I3. J2. K1.)"));
  // A source that writes J before I.
  Maker bore;
  ir::Measure measure;
  measure.feature = ir::Feature::Bore;
  measure.diameter = number(30);
  measure.setting = ir::OffsetSetting{number(56), {number(1), number(2), nullptr}};
  bore.add(measure).origin.addresses = "GPJDSI";
  CHECK(Target().emit(bore.cycle).has("G65 P9023 I1. D30. S56. J2."));
}
