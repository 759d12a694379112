#include "GibbsRunProject.h"

#include <doctest/doctest.h>

using namespace dotek;
using namespace dotek::tests;

namespace {

// The value of `expression` as a path prints it, after the lines `before`; else the finding.
std::string value(const std::string& expression, const std::string& before = "",
                  std::set<std::string> assumptions = {}) {
  const std::string result =
      refusal(before + "\nadd_custom_drill_cycle_path feed_x, " + expression + "\n", std::move(assumptions));
  return result.starts_with("x ") ? result.substr(2, result.size() - 3) : result;
}

} // namespace

TEST_CASE("precedence, functions and texts") {
  CHECK(value("3+9/2") == "7.5");
  CHECK(value("-(2+3)*-2") == "10");
  CHECK(value("10-3-2") == "5");
  CHECK(value("8/4/2") == "1");
  CHECK(value("abs(-2.5)+INT(-1.5)+sqrt(16)") == "5.5");
  CHECK(value("sin(30)", "DEGREES") == "0.5");
  CHECK(value("cos(0)", "RADIANS") == "1");
  CHECK(value("atan(1)", "degrees") == "45");
  CHECK(value("angle_line(-1, 0)", "degrees") == "180");
  CHECK(value("sin(90)", "", {"angle-degrees"}) == "1");
  CHECK(value("len(\"four\")") == "4");
  CHECK(value("val(\" -2.5 \")") == "-2.5");
  CHECK(value("asc(\"A\")") == "65");
  CHECK(value("val(left$(\"123456\", 2) )") == "12");
  CHECK(value("val(right$(\"123456\", 2))") == "56");
  CHECK(value("val(mid$(\"123456\", 2, 3))") == "234");
  CHECK(value("len(mid$(\"abc\", 9, 3))") == "0");
  CHECK(value("len(ltrim$(\"  a \"))*100+len(rtrim$(\"  a \"))*10+len(trim$(\"  a \"))") == "231");
  CHECK(value("x", "x = 0\nif ucase$(\"aB\") = \"AB\" then x = 1") == "1");
  CHECK(value("x", "x = 0\nif lcase$(\"aB\") <> \"ab\" then x = 1") == "0");
  CHECK(value("asc(chr$(66))") == "66");
}

TEST_CASE("names compare without case, text names are their own") {
  CHECK(value("VaLue", "value = 3") == "3");
  CHECK(value("a + len(a$)", "a = 1\na$ = \"xy\"") == "3");
}

TEST_CASE("FOR tests at its end") {
  CHECK(value("n*100+i", "n = 0\nFOR i = 1 TO 3\nn = n+1\nNEXT i") == "304");
  CHECK(value("n*100+i", "n = 0\nFOR i = 5 TO 1\nn = n+1\nNEXT i") == "106");
  CHECK(value("n*100+i", "n = 0\nFOR i = 0 TO 1 STEP 0.5\nn = n+1\nNEXT i") == "301.5");
  CHECK(value("n", "n = 0\nFOR i = 1 TO 3\nIF i = 2 THEN CONTINUE\nn = n+i\nNEXT i") == "4");
  CHECK(value("n", "n = 0\nFOR i = 1 TO 3\nFOR j = 1 TO 2\nn = n+1\nNEXT j\nNEXT i") == "6");
  CHECK(value("i", "FOR i = 1 TO 9\nIF i = 4 THEN GOTO out\nNEXT i\nout:") == "4");
  CHECK(value("n", "n = 0\n:top\nFOR i = 1 TO 9\nn = n+1\nIF n < 5 THEN GOTO top\nNEXT i") == "13");
}

TEST_CASE("a loop whose end or step moves is refused where the readings differ") {
  CHECK(value("i", "e = 3\nFOR i = 1 TO e\ne = e\nNEXT i") == "4");
  CHECK(value("i", "e = 3\nFOR i = 1 TO e\ne = e + 0.1\nNEXT i") == "4");
  CHECK(value("i", "e = 3\nFOR i = 1 TO e\ne = 9\nNEXT i") == "unverified-construct-run@e");
  CHECK(value("i", "e = 3\nFOR i = 1 TO e\ne = 9\nNEXT i", {"for-end-at-entry"}) == "4");
  CHECK(value("i", "FOR i = 3 TO 1 STEP -1\nNEXT i") == "unverified-construct-run@-1");
  CHECK(value("i", "FOR i = 3 TO 1 STEP -1\nNEXT i", {"negative-step"}) == "0");
}

TEST_CASE("jumps into loops and loops that do not close") {
  CHECK(value("1", "GOTO mid\nFOR i = 1 TO 2\n:mid\nNEXT i") == "unverified-construct-run@GOTO mid");
  CHECK(value("i", "i = 1\nGOTO mid\nFOR i = 1 TO 2\n:mid\nNEXT i", {"goto-into-for"}) == "3");
  CHECK(value("1", "FOR i = 1 TO 2") == "cannot-run@FOR i = 1 TO 2");
  CHECK(value("1", "NEXT i") == "cannot-run@NEXT i");
  CHECK(value("1", "CONTINUE") == "cannot-run@CONTINUE");
  CHECK(value("1", "FOR i = 1 TO 2\nNEXT") == "unverified-construct-run@NEXT");
  CHECK(value("i", "FOR i = 1 TO 2\nNEXT", {"next-without-name"}) == "3");
  CHECK(value("1", "GOTO nowhere") == "cannot-run@nowhere");
  CHECK(value("1", "GOTO a\na:\na:") == "cannot-run@a");
  CHECK(value("1", "IF 1 = 2 THEN GOTO nowhere") == "1");
}

TEST_CASE("scopes") {
  GibbsProject project("LOCAL mine\nmine = 1\nours = 2\nCALL \"sub\"\n"
                       "add_custom_drill_cycle_path feed, mine, ours, theirs\n");
  project.files["sub.mac"] = "LOCAL mine\nmine = 50\nours = ours + 1\ntheirs = mine\n";
  CHECK(project.path() == "feed(1,3,50)\n");
  CHECK(project.findings() == "");

  GibbsProject values("v = 1\nCALL \"sub\", v\nadd_custom_drill_cycle_path feed_x, v\n");
  values.files["sub.mac"] = "ARGS v\nv = v + 5\n";
  CHECK(values.path() == "x 1\n");

  GibbsProject hidden("LOCAL mine\nmine = 1\nCALL \"sub\"\n");
  hidden.files["sub.mac"] = "x = mine\n";
  CHECK(hidden.path() == "");
  CHECK(hidden.findings() == "read-before-set@mine");
}

TEST_CASE("calls that do not fit") {
  const auto call = [](const std::string& line, const std::string& sub) {
    GibbsProject project(line + "\n");
    project.files["sub.mac"] = sub;
    project.path();
    return project.findings();
  };
  CHECK(call("CALL \"sub\", 1, 2", "ARGS a\n") == "args-mismatch@CALL \"sub\", 1, 2");
  CHECK(call("CALL \"sub\", 1", "x = 1\n") == "args-mismatch@CALL \"sub\", 1");
  CHECK(call("CALL \"sub\"", "ARGS a\n") == "args-mismatch@CALL \"sub\"");
  CHECK(call("CALL \"sub\", 1", "ARGS a$\n") == "kind-mismatch-run@a$");
  CHECK(call("CALL \"sub\"", "CALL \"sub\"\n") == "call-too-deep@CALL \"sub\"");
  CHECK(call("CALL \"gone\"", "") == "cannot-run@\"gone\"");
  CHECK(call("#INCLUDE \"gone\"", "") == "cannot-run@\"gone\"");
  CHECK(call("#INCLUDE \"sub\"", "#INCLUDE \"sub\"\n") == "cannot-run@\"sub\"");
}

TEST_CASE("errors jump to the handler, or are refused at their place") {
  CHECK(value("1/z", "z = 0") == "division-by-zero@1/z");
  CHECK(value("sqrt(0-1)") == "domain-error@sqrt(0-1)");
  CHECK(value("asin(2)", "degrees") == "domain-error@asin(2)");
  CHECK(value("val(\"x\")") == "domain-error@val(\"x\")");
  CHECK(value("asc(\"xy\")") == "domain-error@asc(\"xy\")");
  CHECK(value("x", "ON_ERROR GOTO caught\nz = 0\nx = 1/z\nx = 2\nGOTO on\n:caught\nx = 3\n:on") == "3");
  CHECK(value("x", "ON_ERROR GOTO gone\nx = 1/0") == "cannot-run@gone");
}

TEST_CASE("a run that does not end") {
  GibbsProject project(":a\ngoto a\n");
  project.limits.steps = 1000;
  CHECK(project.path() == "");
  CHECK(project.findings() == "runs-forever@goto a");
  GibbsProject loop("FOR i = 1 TO 2 STEP 0\nx = 1\nNEXT i\n");
  loop.limits.steps = 1000;
  CHECK(loop.verdict() == "not run");
  CHECK(loop.findings().starts_with("runs-forever@"));
  GibbsProject talks(":a\nmessage \"x\"\ngoto a\n");
  talks.limits.outputBytes = 1000;
  CHECK(talks.verdict() == "not run");
  CHECK(talks.findings().starts_with("run-too-large@"));
}

TEST_CASE("unverified constructs are refused where they are reached, and run where they are assumed") {
  CHECK(value("x") == "read-before-set@x");
  CHECK(value("x", "", {"unset-zero"}) == "0");
  CHECK(value("len(x$)", "", {"unset-zero"}) == "0");
  CHECK(value("sin(1)") == "angle-unit-open@sin");
  CHECK(value("1e2") == "unverified-construct-run@1e2");
  CHECK(value("1e2", "", {"exponent"}) == "100");
  CHECK(value(".5") == "unverified-construct-run@.5");
  CHECK(value(".5", "", {"bare-fraction"}) == "0.5");
  CHECK(value("len('ab')") == "unverified-construct-run@'ab'");
  CHECK(value("len('ab')", "", {"single-quotes"}) == "2");
  CHECK(value("len(\"a\" + \"b\")") == "unverified-construct-run@\"a\" + \"b\"");
  CHECK(value("len(\"a\" + \"b\")", "", {"text-join"}) == "2");
  CHECK(value("x", "x = 1\nIF 1 = 1 AND 2 = 3 THEN x = 2") == "unverified-construct-run@1 = 1 AND 2 = 3");
  CHECK(value("x", "x = 1\nIF 1 = 1 AND 2 = 3 THEN x = 2", {"and-or"}) == "1");
  CHECK(value("x", "x = 1\nIF 1 = 1 OR 2 = 3 AND 1 = 2 THEN x = 2", {"and-or"}) == "2");
  CHECK(value("x", "x = 1\nIF NOT 1 = 2 THEN x = 2") == "unverified-construct-run@NOT");
  CHECK(value("x", "x = 1\nIF NOT 1 = 2 THEN x = 2", {"not"}) == "2");
  CHECK(value("x", "x = 1\nIF \"a\" = \"A\" THEN x = 2") == "unverified-construct-run@\"a\" = \"A\"");
  CHECK(value("1", "IF 1 = 2 THEN x = .5") == "1");
}

TEST_CASE("blocks and arrays under assumption") {
  const std::string block = "x = 1\nIF x = 1 THEN\n[\nx = 5\nx = x + 1\n]\n";
  CHECK(value("x", block).starts_with("unverified-construct-run@"));
  CHECK(value("x", block, {"block-if"}) == "6");
  const std::string either = "x = 1\nIF x = 2 THEN x = 5 ELSE x = 7\n";
  CHECK(value("x", either) == "unverified-construct-run@ELSE");
  CHECK(value("x", either, {"else"}) == "7");
  const std::string array = "LOCAL a[3]\na[1] = 4\na[3] = 5\n";
  CHECK(value("a[1]+a[3]", array).starts_with("unverified-construct-run@"));
  CHECK(value("a[1]+a[3]", array, {"array-square"}) == "9");
  CHECK(value("a[2]", array, {"array-square"}) == "read-before-set@a");
  CHECK(value("a[4]", array, {"array-square"}) == "cannot-run@4");
  CHECK(value("b[1]", array, {"array-square"}) == "cannot-run@1");
}

TEST_CASE("numbers and texts do not mix") {
  CHECK(value("1", "a = \"x\"") == "kind-mismatch-run@a");
  CHECK(value("1", "a$ = 1") == "kind-mismatch-run@a$");
  CHECK(value("1 + \"x\"") == "kind-mismatch-run@\"x\"");
  CHECK(value("1", "IF \"x\" = 1 THEN a = 1") == "kind-mismatch-run@\"x\" = 1");
  CHECK(value("1", "IF \"x\" < \"y\" THEN a = 1") == "cannot-run@\"x\" < \"y\"");
  CHECK(value("1", "a$ = \"" + std::string(1001, 'x') + "\"").starts_with("text-overflow@"));
}

TEST_CASE("names of the CAM") {
  CHECK(value("1", "LAST_OP_NUMBER = 3") == "system-name-written@LAST_OP_NUMBER");
  CHECK(value("1", "callback_op = 3") == "system-name-written@callback_op");
  CHECK(value("LAST_OP_NUMBER") == "unknown-value@LAST_OP_NUMBER");
  CHECK(value("x", "x = 1\nIF TOOL_TYPE_DRILL = TOOL_TYPE_DRILL THEN x = 2") == "2");
}
