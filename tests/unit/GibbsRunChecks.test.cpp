#include "GibbsRunProject.h"

#include <doctest/doctest.h>

using namespace dotek;
using namespace dotek::tests;

namespace {

std::string verdict(const std::string& macro, std::map<std::string, double> fields,
                    std::map<std::string, double> hosts = {}) {
  GibbsProject project(macro);
  project.fields = std::move(fields);
  project.hosts = std::move(hosts);
  const std::string text = project.verdict();
  return project.findings().empty() ? text : text + " " + project.findings();
}

// Sets r to the radius of the tool.
const std::string kRadius = "get_proc_data callback_proc, tool_num, t\nget_tool_data t, mtool_radius, r\n";

} // namespace

TEST_CASE("a message in the condition, and a jump by the same one") {
  const std::string macro = ":again\ndialog \"d.dlg\"\nif w < 2 then message \"w is too small\"\n"
                            "if w < 2 then goto again\n";
  CHECK(verdict(macro, {{"w", 3}}) == "passes");
  CHECK(verdict(macro, {{"w", 1}}) == "rejected [w is too small]");
}

TEST_CASE("a chain of jumps") {
  const std::string macro =
      "show:\ndialog \"d.dlg\"\nif w < 2 then goto low\nif w > 9 then goto high\ngoto done\n"
      "low:\nmessage \"low\"\ngoto show\nhigh:\nmessage \"high\"\ngoto show\ndone:\n"
      "callback_returncode = 0\n";
  CHECK(verdict(macro, {{"w", 5}}) == "passes");
  CHECK(verdict(macro, {{"w", 1}}) == "rejected [low]");
  CHECK(verdict(macro, {{"w", 10}}) == "rejected [high]");
}

TEST_CASE("a loop over checks") {
  const std::string macro = ":again\ndialog \"d.dlg\"\nbad = 0\nFOR i = 1 TO 3\n  IF i = 1 THEN v = a\n"
                            "  IF i = 2 THEN v = b\n  IF i = 3 THEN v = c\n  IF v >= 0 THEN CONTINUE\n"
                            "  bad = bad + 1\n  IF bad > 1 THEN CONTINUE\n  message \"negative\"\nNEXT i\n"
                            "if bad <> 0 then goto again\n";
  CHECK(verdict(macro, {{"a", 1}, {"b", 0}, {"c", 1}}) == "passes");
  CHECK(verdict(macro, {{"a", -1}, {"b", 0}, {"c", -1}}) == "rejected [negative]");
}

TEST_CASE("a check in a called macro, and one in an included file") {
  GibbsProject project(":again\ndialog \"d.dlg\"\nok = 1\ncall \"between\", w, 2, 9\n#include \"more.mac\"\n"
                       "if ok = 0 then goto again\n");
  project.files["between.mac"] =
      "ARGS value, low, high\nif value < low then ok = 0\nif value > high then ok = 0\n"
      "if ok = 0 then message \"out of range\"\n";
  project.files["more.mac"] = "if w <> 4 then goto fine\nmessage \"not 4\"\nok = 0\n:fine\n";
  project.fields = {{"w", 3}};
  SUBCASE("passes") {
    CHECK(project.verdict() == "passes");
  }
  SUBCASE("called") {
    project.fields["w"] = 10;
    CHECK(project.verdict() == "rejected [out of range]");
  }
  SUBCASE("included") {
    project.fields["w"] = 4;
    CHECK(project.verdict() == "rejected [not 4]");
  }
  CHECK(project.findings() == "");
}

TEST_CASE("a return code only") {
  const std::string macro =
      "callback_returncode = 0\ndialog \"d.dlg\"\nif w < 2 then callback_returncode = 7\n";
  CHECK(verdict(macro, {{"w", 2}}) == "passes");
  CHECK(verdict(macro, {{"w", 1}}) == "rejected []");
  CHECK(verdict("dialog \"d\"\nif w < 2 then message \"small\"\nif w < 2 then callback_returncode = 1\n",
                {{"w", 1}}) == "rejected [small]");
}

TEST_CASE("checks before the dialog, without one, and STOP") {
  CHECK(verdict("if w < 2 then stop \"no\"\ndialog \"d\"\n", {{"w", 1}}) == "rejected [no]");
  CHECK(verdict("if w < 2 then stop\n", {{"w", 1}}) == "rejected []");
  CHECK(verdict("if w < 2 then stop\n", {{"w", 2}}) == "passes");
  CHECK(verdict("message \"welcome\"\ndialog \"d\"\nif w < 2 then message \"small, but well\"\n",
                {{"w", 1}}) == "passes shown[welcome] shown[small, but well]");
  CHECK(verdict("message \"welcome\"\n:a\ndialog \"d\"\nif w < 2 then goto a\n", {{"w", 1}}) ==
        "rejected []");
}

TEST_CASE("a second page is no second try") {
  CHECK(verdict("dialog \"one\"\ndialog \"two\"\n", {{"w", 1}}) == "passes");
  CHECK(verdict("dialog \"one\"\nif w < 2 then dialog \"ONE\"\n", {{"w", 1}}) == "rejected []");
}

TEST_CASE("the dialog stores what was typed into its inputs") {
  GibbsProject project(
      "w = 99\nv = 99\ndialog \"d.dlg\"\nif w > 50 then stop \"w\"\nif extra <> 4 then stop \"extra\"\n");
  project.files["d.dlg"] =
      "DIALOG \"x\", 1, 1, 200, 200\nINPUT 10, 10, 40, 20, w, w\nINPUT 10, 40, 40, 20, extra, 4\n"
      "OK 10, 80, 60, 20\nCANCEL 80, 80, 60, 20\n";
  project.fields = {{"w", 1}, {"v", 2}};
  CHECK(project.verdict() == "passes V=99");
  CHECK(project.findings() == "");
}

TEST_CASE("changed fields") {
  CHECK(verdict("dialog \"d\"\nif w < 2 then w = 2\n", {{"w", 1}}) == "passes W=2");
  CHECK(verdict("dialog \"d\"\nif w < 2 then w = 2\n", {{"w", 3}}) == "passes");
  CHECK(verdict(kRadius + "dialog \"d\"\nw = r\n", {{"w", 1}}).starts_with("not run field-open@"));
  CHECK(verdict(kRadius + "dialog \"d\"\nif r > 1 then w = 5\n", {{"w", 1}})
            .starts_with("not run field-open@"));
}

TEST_CASE("a changed field knows where, a message prints its numbers") {
  GibbsProject project;
  project.files["main"] = "get_part_data part_name, part$\ndialog \"d\"\nw = 2\nmessage w\nmessage part$\n";
  project.fields = {{"w", 1}};
  const gibbs::ChecksResult result = project.checks();
  REQUIRE(result.changedAt.size() == 1);
  CHECK(project.sources.text(result.changedAt[0]) == "w = 2");
  REQUIRE(result.shown.size() == 2);
  CHECK(result.shown[0].text == "2");
  CHECK(result.shown[1].text == "<part$>");
}

TEST_CASE("an unknown radius leaves the verdict open, or not") {
  const std::string macro = kRadius + ":again\ndialog \"d\"\ncode = 0\nif g < 54 then code = 1\n"
                                      "if abs(a) < r then code = 2\nif code = 1 then message \"g\"\n"
                                      "if code = 2 then message \"a\"\nif code > 0 then goto again\n";
  CHECK(verdict(macro, {{"a", 5}, {"g", 54}}) == "depends [a] tool_radius");
  CHECK(verdict(macro, {{"a", 5}, {"g", 54}}, {{"tool_radius", 3}}) == "passes");
  CHECK(verdict(macro, {{"a", 2}, {"g", 54}}, {{"tool_radius", 3}}) == "rejected [a]");
  CHECK(verdict(macro, {{"a", 5}, {"g", 1}}) == "rejected [g] [a]");
}

TEST_CASE("conditions on one unknown exclude each other") {
  // On no path is code left unset, and none meets r < 3 and r >= 3.
  CHECK(verdict(kRadius + "dialog \"d\"\nif r < 3 then code = 1\nif r >= 3 then code = 2\n"
                          "if code > 5 then stop \"never\"\n",
                {}) == "passes");
  CHECK(verdict(kRadius + "dialog \"d\"\nif 2*r - 1 > 5 then goto on\nif r > 4 then stop \"never\"\n:on\n",
                {}) == "passes");
  CHECK(verdict(kRadius + "dialog \"d\"\nif r - r <> 0 then stop \"never\"\n", {}) == "passes");
  CHECK(
      verdict(kRadius + "dialog \"d\"\nif abs(r) < 1 then goto on\nif abs(r) < 1 then stop \"never\"\n:on\n",
              {}) == "passes");
  CHECK(
      verdict(
          "get_part_data part_name, n$\nif n$ = \"a\" then goto on\nif n$ = \"a\" then stop \"never\"\n:on\n",
          {}) == "passes");
}

TEST_CASE("what no host input follows is named in a note") {
  CHECK(verdict("get_tool_data 1, mtool_length, l\ndialog \"d\"\nif l < 50 then stop \"short\"\n", {}) ==
        "depends [short] condition-open@l < 50");
}

TEST_CASE("the return code may depend on a host input") {
  CHECK(verdict(kRadius + "dialog \"d\"\ncallback_returncode = r - 3\n", {}) == "depends [] tool_radius");
}

TEST_CASE("what needs the user is not run") {
  CHECK(verdict("input \"how much\", x\n", {}) == "not run needs-user@input");
  CHECK(verdict("yesno \"sure\", x\n", {}) == "not run needs-user@yesno");
  CHECK(verdict("file_dialog_show OPEN, f$\n", {}) == "not run needs-user@file_dialog_show");
  CHECK(verdict("run_exe \"x.exe\"\n", {}) == "not run needs-user@run_exe");
  GibbsProject project("input \"how much\", x\n");
  project.checks();
  CHECK(project.diagnostics.all()[0].severity == Severity::Warning);
}

TEST_CASE("commands without a result are passed over, unknown results stay unknown") {
  CHECK(verdict("debug w, \"text\"\ntrace on\nsleep 10\nfile_open 1, \"f\", write\nfile_write_vars 1, "
                "w\nfile_close 1\n"
                "dialog \"d\"\n",
                {{"w", 1}}) == "passes");
  CHECK(verdict("file_exists \"f\", s\nif s = 1 then stop \"there\"\n", {}) ==
        "depends [there] condition-open@s = 1");
  CHECK(verdict("debug never_set\n", {}) == "passes");
  CHECK(verdict("x = 1\nfrobnicate x\nif x = 1 then stop \"one\"\n", {}) ==
        "depends [one] unknown-command-run@frobnicate; condition-open@x = 1");
  CHECK(verdict("a = 1\nb = 2\nswap_values a, b\nif a <> 2 then stop\n", {}) == "passes");
}

TEST_CASE("the parameter keyword is no variable") {
  CHECK(verdict("x = 4\nget_custom_drill_cycle_data x, x1\nif x1 <> 10 then stop\nif x <> 4 then stop\n", {},
                {{"start_x", 10}}) == "passes");
}

TEST_CASE("too many paths, and steps of all of them together") {
  GibbsProject project;
  std::string macro;
  for (int i = 0; i < 20; ++i) {
    macro += "get_tool_data " + std::to_string(i) + ", mtool_length, l\nif l > 1 then x = 1\n";
  }
  project.files["main"] = macro;
  CHECK(project.verdict() == "not run");
  CHECK(project.findings().starts_with("too-many-paths@l > 1"));
}
