// A statement means the same whether a macro runs on numbers or is lowered: what one refuses, the other
// refuses at the same place, and what one computes, the other computes.
#include "tests/unit/GibbsLowerProject.h"

#include <doctest/doctest.h>

using namespace dotek;
using namespace dotek::tests;

namespace {

const std::string kFields = "a = 10\nb = 4\n";
const std::string kTool = "p = callback_proc\nget_proc_data p, TOOL_NUM, t\n";

LowerProject projectOf(const std::string& checks, const std::set<std::string>& assumptions) {
  LowerProject project(kFields, checks);
  project.assumptions = assumptions;
  project.files["d.dlg"] = "DIALOG \"x\", 1, 1, 200, 200\nINPUT 10, 10, 40, 20, a, a\n"
                           "INPUT 10, 40, 40, 20, extra\nOK 10, 80, 60, 20\nCANCEL 80, 80, 60, 20\n";
  return project;
}

// Findings of the run, and of the lowering where they are others.
std::string refusals(const std::string& checks, const std::set<std::string>& assumptions = {}) {
  LowerProject run = projectOf(checks, assumptions);
  run.fields = {{"a", 10}, {"b", 4}};
  run.files["main"] = checks;
  run.verdict();
  LowerProject lowered = projectOf(checks, assumptions);
  lowered.lowerChecks();
  return run.findings() == lowered.findings() ? run.findings() : run.findings() + " | " + lowered.findings();
}

// "both paths" where the lowered checks agree with the run for values of either verdict.
std::string compared(const std::string& checks, const std::set<std::string>& assumptions = {}) {
  LowerProject project = projectOf(checks, assumptions);
  return project.lowerChecks() ? project.compareOnValues() : "refused: " + project.findings();
}

} // namespace

TEST_CASE("gibbs domains: what no value makes right is refused at one place") {
  CHECK(refusals("dialog \"e.dlg\"\nx = val(\"ten\")\n") == "domain-error@val(\"ten\")");
  CHECK(refusals("dialog \"e.dlg\"\nx$ = mid$(\"ten\", 0, 1)\n") == "domain-error@mid$(\"ten\", 0, 1)");
  CHECK(refusals("dialog \"e.dlg\"\nx = 1 / 0\n") == "division-by-zero@1 / 0");
  CHECK(refusals(kTool + "set_tool_data t, mtool_radius, 1 / 0\ndialog \"e.dlg\"\n") ==
        "division-by-zero@1 / 0");
  CHECK(refusals("dialog \"e.dlg\"\nlocal x(3)\n") == "unverified-construct-run@x");
  CHECK(refusals("dialog \"e.dlg\"\nx = len(b)\n") == "kind-mismatch-run@b");
  CHECK(refusals("dialog \"e.dlg\"\nx$ = b\n") == "kind-mismatch-run@x$");
  CHECK(refusals("dialog \"e.dlg\"\ntool_type_drill = 3\n") == "system-name-written@tool_type_drill");
  CHECK(refusals("dialog \"e.dlg\"\nif 1 < \"a\" then stop\n") == "kind-mismatch-run@1 < \"a\"");
}

TEST_CASE("gibbs domains: a result needs a variable, and the message says so") {
  const std::string checks = kTool + "get_tool_data t, mtool_radius, 3\n";
  LowerProject run = projectOf(checks, {});
  run.files["main"] = checks;
  run.verdict();
  LowerProject lowered = projectOf(checks, {});
  lowered.lowerChecks();
  REQUIRE(run.diagnostics.all().size() == 1);
  REQUIRE(lowered.diagnostics.all().size() == 1);
  const std::string why = "the command writes its result to what is no variable";
  CHECK(run.diagnostics.all()[0].message.starts_with(why));
  CHECK(lowered.diagnostics.all()[0].message.starts_with(why));
}

TEST_CASE("gibbs domains: functions of known texts have a value") {
  CHECK(compared(":ask\ndialog \"e.dlg\"\nm$ = \"low\"\nif a < 5 then m$ = trim$(\" high \")\n"
                 "if ucase$(m$) = \"LOW\" then goto done\nmessage m$\ngoto ask\n:done\n") == "both paths");
  CHECK(compared(":ask\ndialog \"e.dlg\"\nif a < val(left$(\"54\", 1)) + len(\"ab\") then goto ask\n"
                 "if b > asc(chr$(6)) then goto ask\n") == "both paths");
}

TEST_CASE("gibbs domains: what is typed into an input without default is not known") {
  // `extra` is no field of the cycle, and that the macro has set it says nothing of what the user leaves
  // there.
  const std::string checks = "extra = 1\n:ask\ndialog \"d.dlg\"\nif extra < a then stop \"extra\"\n";
  LowerProject run = projectOf(checks, {});
  run.files["main"] = checks;
  run.fields = {{"a", 10}, {"b", 4}};
  CHECK(run.verdict() == "depends [extra]");
  CHECK(run.findings() == "condition-open@extra < a");
  LowerProject lowered = projectOf(checks, {});
  CHECK_FALSE(lowered.lowerChecks());
  CHECK(lowered.findings() == "cam-value@extra");
}

TEST_CASE("gibbs domains: a host input that the macro changes is another value") {
  const std::string checks = kTool + "set_tool_data t, mtool_radius, 5\nget_tool_data t, mtool_radius, r\n"
                                     "dialog \"e.dlg\"\nif a < r then stop \"near\"\n";
  LowerProject run = projectOf(checks, {});
  run.files["main"] = checks;
  run.fields = {{"a", 4}, {"b", 4}};
  CHECK(run.verdict() == "rejected [near]");
  LowerProject lowered = projectOf(checks, {});
  CHECK_FALSE(lowered.lowerChecks());
  CHECK(lowered.findings() == "cam-value@r");
}

TEST_CASE("gibbs domains: an unknown number beside one near the largest does no harm") {
  const std::string checks = kTool + "get_tool_data t, mtool_radius, r\n"
                                     "for i = r + 1.7E308 to r + 1 step 1.7E308\nnext i\n";
  LowerProject run = projectOf(checks, {"exponent"});
  run.files["main"] = checks;
  CHECK(run.verdict() == "not run");
  CHECK(run.findings() == "too-many-paths@next i");
}
