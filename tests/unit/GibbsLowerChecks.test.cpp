// Checks of CycleData.mac as code: what the interpreter rejects, the lowered checks reject with the
// message that it shows.
#include "tests/unit/GibbsLowerProject.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

namespace fs = std::filesystem;
using namespace dotek;
using namespace dotek::tests;

namespace {

const std::string kFields = "G = 54\na = 10\nb = 4\nc = -3\n";

// The lowered checks as text, or the findings where they were refused.
std::string lowered(const std::string& checks, const std::set<std::string>& assumptions = {},
                    const std::string& fields = kFields) {
  LowerProject project(fields, checks);
  project.assumptions = assumptions;
  return project.lowerChecks() ? project.text(project.cycle.checks) : project.findings();
}

std::string compared(const std::string& checks, const std::set<std::string>& assumptions = {},
                     const std::map<std::string, std::string>& others = {}) {
  LowerProject project(kFields, checks);
  project.assumptions = assumptions;
  for (const auto& [name, text] : others)
    project.files[name] = text;
  if (!project.lowerChecks()) return "refused: " + project.findings();
  return project.compareOnValues();
}

std::string comparedFolder(const fs::path& folder) {
  LowerProject project;
  project.readFolder(folder);
  if (!project.lowerChecks()) return "refused: " + project.findings();
  if (!project.diagnostics.empty()) return project.findings();
  return project.compareOnValues(1000);
}

} // namespace

TEST_CASE("gibbs lower: a cycle declares its fields with what the dialog says of them") {
  LowerProject project("Z = -5\n! depth\nzb = 50.50\nlone = 1", "");
  project.files["CycleData.dlg"] = "dialog \"Surface in \xF8"
                                   "ad\xEC\", 30, 50, 400, 520\n"
                                   "label 20, 340, 120, 24, \"Z [mm]\"\ninput 80, 335, 70, 24, Z, Z\n"
                                   "label 155, 340, 160, 24, \"depth of the touch\"\n"
                                   "input 80, 385, 70, 24, extra, 7\n"
                                   "ok 1, 1, 1, 1\ncancel 1, 1, 1, 1\n";
  project.declare();
  CHECK(project.cycle.title == "Surface in \u0159ad\u011B");
  REQUIRE(project.cycle.variables.size() == 4);
  const ir::Variable& z = project.cycle.variables[0];
  CHECK(z.name == "Z");
  CHECK(z.role == ir::Role::Parameter);
  CHECK(z.defaultValue == -5.0);
  CHECK(z.unit == "mm");
  CHECK(z.meaning == "depth of the touch");
  CHECK(project.cycle.variables[1].defaultDigits == "50.50");
  CHECK(project.cycle.variables[2].name == "lone");
  CHECK(project.cycle.variables[2].meaning == "");
  CHECK(project.cycle.variables[3].name == "extra");
  CHECK(project.cycle.variables[3].defaultValue == 7.0);
}

TEST_CASE("gibbs lower: two fields of which the dialog says the same are told apart by their names there") {
  LowerProject project("px = 0\npy = 0\nlone = 1", "");
  project.files["CycleData.dlg"] = "dialog \"Point\", 30, 50, 400, 520\n"
                                   "label 20, 40, 50, 24, \"X [mm]\"\ninput 80, 40, 70, 24, px, px\n"
                                   "label 155, 40, 160, 24, \"point on the face\"\n"
                                   "label 20, 80, 50, 24, \"Y [mm]\"\ninput 80, 80, 70, 24, py, py\n"
                                   "label 155, 80, 160, 24, \"point on the face\"\n"
                                   "label 20, 120, 50, 24, \"Z [mm]\"\ninput 80, 120, 70, 24, lone, lone\n"
                                   "label 155, 120, 160, 24, \"height\"\n"
                                   "ok 1, 1, 1, 1\ncancel 1, 1, 1, 1\n";
  project.declare();
  REQUIRE(project.cycle.variables.size() == 3);
  CHECK(project.cycle.variables[0].meaning == "X, point on the face");
  CHECK(project.cycle.variables[1].meaning == "Y, point on the face");
  CHECK(project.cycle.variables[2].meaning == "height");
}

TEST_CASE("gibbs lower: checks of the examples agree with the interpreter") {
  for (const char* name : {"surface-x", "surface-y", "surface-z", "corner-xyz", "bore"}) {
    INFO(name);
    CHECK(comparedFolder(root() / "examples" / name) == "both paths");
  }
}

TEST_CASE("gibbs lower: checks of the corpus agree with the interpreter") {
  fs::path folder;
  if (!haveCorpus(folder)) return;
  int folders = 0;
  for (const auto& entry : fs::directory_iterator(folder / "gibbs")) {
    if (!entry.is_directory()) continue;
    ++folders;
    INFO(entry.path().filename().string());
    CHECK(comparedFolder(entry.path()) == "both paths");
  }
  CHECK(folders > 0);
}

TEST_CASE("gibbs lower: a message becomes an alarm at its place") {
  CHECK(lowered("callback_returncode = 0\n:ask\ndialog \"d.dlg\"\nbad = 0\nif G < 54 then bad = 1\n"
                "if bad = 1 then message \"offset\"\nif bad > 0 then goto ask\n") ==
        "callback_returncode = 0\nbad = 0\nG>=54 -> L1\nbad = 1\nL1:\nbad<>1 -> L2\nalarm [offset]\nL2:\n");
  // Without a message the path back itself is the alarm.
  CHECK(lowered(":ask\ndialog \"d.dlg\"\nif G < 54 then goto ask\n") == "G>=54 -> L1\nalarm []\nL1:\n");
  CHECK(lowered(":ask\ndialog \"d.dlg\"\nif G < 54 then stop \"no\"\n") == "G>=54 -> L1\nalarm [no]\nL1:\n");
  // Several messages on the path back: the first one that the user sees.
  CHECK(lowered(
            ":ask\ndialog \"d.dlg\"\nif G >= 54 then goto done\nmessage \"one\"\nmessage \"two\"\ngoto ask\n"
            ":done\n") == "G>=54 -> L1\nalarm [one]\nL1:\n");
}

TEST_CASE("gibbs lower: shapes of checks agree with the interpreter") {
  const std::string data =
      "p = callback_proc\nget_proc_data p, TOOL_NUM, t\nget_tool_data t, MTOOL_RADIUS, r\n";
  SUBCASE("chain of GOTO") {
    CHECK(
        compared(data +
                 ":ask\ndialog \"d.dlg\"\nif G < 54 then goto low\nif abs(a) <= r then goto near\n"
                 "goto done\n:low\nmessage \"low\"\ngoto ask\n:near\nmessage \"near\"\ngoto ask\n:done\n") ==
        "both paths");
  }
  SUBCASE("message, then the same condition again") {
    CHECK(compared(":ask\ndialog \"d.dlg\"\nif G < 54 then message \"low\"\nif G < 54 then goto ask\n"
                   "if a > 20 then message \"far\"\nif a > 20 then goto ask\n") == "both paths");
  }
  SUBCASE("a count of mistakes") {
    CHECK(compared(
              ":ask\ndialog \"d.dlg\"\nbad = 0\nif G < 54 then bad = bad + 1\nif a > b then bad = bad + 1\n"
              "if bad > 0 then message \"wrong\"\nif bad > 0 then goto ask\n") == "both paths");
  }
  SUBCASE("block IF with ELSE") {
    CHECK(
        compared(":ask\ndialog \"d.dlg\"\nif a > 0 then\n[\nif b > a then\n[\nmessage \"b\"\ngoto ask\n]\n]\n"
                 "else\n[\nif c >= 0 then\n[\nmessage \"c\"\ngoto ask\n]\n]\n",
                 {"block-if", "else"}) == "both paths");
  }
  SUBCASE("AND, OR, NOT") {
    CHECK(compared(":ask\ndialog \"d.dlg\"\nif G < 54 or G > 59 and a > 0 then goto bad\n"
                   "if not b > c then goto bad\ngoto done\n:bad\nmessage \"bad\"\ngoto ask\n:done\n",
                   {"and-or", "not"}) == "both paths");
  }
  SUBCASE("FOR over a count") {
    CHECK(
        compared(
            ":ask\ndialog \"d.dlg\"\nsum = 0\nfor i = 1 to 3\nsum = sum + a * i\nif sum > 30 then goto bad\n"
            "next i\nif i <> 4 then goto bad\ngoto done\n:bad\nmessage \"sum\"\ngoto ask\n:done\n") ==
        "both paths");
  }
  SUBCASE("FOR down, and to a field") {
    CHECK(compared(":ask\ndialog \"d.dlg\"\nn = 0\nfor i = 6 to b step -2\nn = n + 1\nif n > 9 then goto "
                   "out\nnext i\n"
                   ":out\nif n > 3 then message \"many\"\nif n > 3 then goto ask\n",
                   {"negative-step"}) == "both paths");
  }
  SUBCASE("macro with values") {
    CHECK(compared(
              data + ":ask\ndialog \"d.dlg\"\nwrong = 0\ncall \"far.mac\", a, r\ncall \"far.mac\", b, r * 2\n"
                     "if wrong > 0 then message \"far\"\nif wrong > 0 then goto ask\n",
              {},
              {{"far.mac", "args v, lim\nlocal d\nd = abs(v) - lim\nif d < 0 then wrong = wrong + 1\n"}}) ==
          "both paths");
  }
  SUBCASE("included lines") {
    CHECK(compared(":ask\ndialog \"d.dlg\"\n#include \"rest.mac\"\n", {},
                   {{"rest.mac", "if G > 59 then message \"high\"\nif G > 59 then goto ask\n"}}) ==
          "both paths");
  }
  SUBCASE("return codes") {
    CHECK(compared("callback_returncode = 0\ndialog \"d.dlg\"\nif G < 54 then callback_returncode = 1\n"
                   "if a < 0 then callback_returncode = 2\n") == "both paths");
    CHECK(compared("callback_returncode = 0\ndialog \"d.dlg\"\nif G >= 54 then goto done\nmessage \"low\"\n"
                   "callback_returncode = 1\n:done\n") == "both paths");
    CHECK(compared("dialog \"d.dlg\"\ncode = 0\nif G < 54 then code = 3\ncallback_returncode = code\n") ==
          "both paths");
    CHECK(compared("dialog \"d.dlg\"\ncallback_returncode = a - 10\n") == "both paths");
  }
  SUBCASE("what was computed before the dialog counts") {
    CHECK(compared(data +
                   "least = r * 2 + 1\nG = 99\n:ask\ndialog \"d.dlg\"\nif a < least then message \"a\"\n"
                   "if a < least then goto ask\nif G = 99 then message \"G\"\nif G = 99 then goto ask\n") ==
          "both paths");
  }
  SUBCASE("a field that the checks change") {
    CHECK(compared(":ask\ndialog \"d.dlg\"\nif a < 0 then a = -a\nif a < 5 then message \"a\"\n"
                   "if a < 5 then goto ask\nswap_values b, c\nif b > c then goto ask\n") == "both paths");
  }
  SUBCASE("texts") {
    CHECK(compared(
              ":ask\ndialog \"d.dlg\"\nm$ = \"\"\nif G < 54 then m$ = \"low\"\nif G > 59 then m$ = \"high\"\n"
              "if m$ = \"\" then goto done\nmessage m$\ngoto ask\n:done\n") == "both paths");
  }
  SUBCASE("functions") {
    CHECK(compared("degrees\n:ask\ndialog \"d.dlg\"\nif int(a) <> a then goto bad\nif sqrt(abs(b)) > 3 then "
                   "goto bad\n"
                   "if sin(c) > 0.2 then goto bad\ngoto done\n:bad\nmessage \"bad\"\ngoto ask\n:done\n") ==
          "both paths");
  }
}

TEST_CASE("gibbs lower: many independent checks stay few paths") {
  std::string checks = ":ask\ndialog \"d.dlg\"\nbad = 0\n";
  std::string fields;
  for (int i = 1; i <= 24; ++i) {
    const std::string name = "f" + std::to_string(i);
    fields += name + " = 1\n";
    checks += "if " + name + " < 0 then bad = " + std::to_string(i) + "\n";
  }
  for (int i = 1; i <= 24; ++i)
    checks += "if bad = " + std::to_string(i) + " then message \"m" + std::to_string(i) + "\"\n";
  checks += "if bad > 0 then goto ask\n";
  LowerProject project(fields, checks);
  CHECK(project.lowerChecks());
  CHECK(project.findings() == "");
  int alarms = 0;
  for (const ir::CycleStatement& each : project.cycle.checks)
    if (std::holds_alternative<ir::Alarm>(each.node)) ++alarms;
  CHECK(alarms == 24);
}

TEST_CASE("gibbs lower: checks that exclude one another are as many paths as checks") {
  constexpr int kChecks = 1500;
  std::string checks = ":ask\ndialog \"d.dlg\"\nbad = 0\n";
  const auto each = [&](std::string_view format) {
    for (int i = 1; i <= kChecks; ++i)
      checks += fmt::format(fmt::runtime(format), i);
  };
  SUBCASE("a number for each") {
    each("if a = {0}.5 then bad = {0}\n");
  }
  SUBCASE("bounds that rise") {
    each("if a > {0} then bad = {0}\n");
  }
  SUBCASE("bounds that rise, the other side") {
    each("if a < -{0} then bad = {0}\n");
  }
  SUBCASE("a message at once") {
    each("if a = {0}.5 then bad = {0}\nif bad = {0} then message \"number {0}\"\n");
  }
  SUBCASE("messages after all checks") {
    each("if a = {0}.5 then bad = {0}\n");
    each("if bad = {0} then message \"number {0}\"\n");
  }
  LowerProject project(kFields, checks + "if bad > 0 then goto ask\n");
  project.limits.paths = 512; // 64 states for each of them
  CHECK(project.lowerChecks());
  CHECK(project.findings() == "");
}

TEST_CASE("gibbs lower: a check for each of many fields") {
  std::string fields, checks = ":ask\ndialog \"d.dlg\"\nbad = 0\n";
  for (int i = 1; i <= 1000; ++i) {
    fields += fmt::format("f{} = 1\n", i);
    checks += fmt::format("if f{} < 0 then bad = {}\n", i, i);
  }
  LowerProject project(fields, checks + "if bad > 0 then message \"wrong\"\nif bad > 0 then goto ask\n");
  project.limits.paths = 128;
  CHECK(project.lowerChecks());
  CHECK(project.findings() == "");
}

// States that no later condition tells apart are one: each message still has its own way.
TEST_CASE("gibbs lower: paths that meet keep what lies behind each message") {
  // The first message lets its values pass, the second does not.
  CHECK(lowered(":ask\ndialog \"d.dlg\"\nbad = 0\nif a = 1 then message \"one\"\nif a = 2 then bad = 2\n"
                "if bad = 2 then message \"two\"\nif bad > 1 then goto ask\n") ==
        "bad = 0\na<>1 -> L1\ncomment [one]\nL1:\na<>2 -> L2\nbad = 2\nL2:\nbad<>2 -> L3\nalarm [two]\n"
        "L3:\n");
  // Both ways are open behind a message whose value may be changed back.
  CHECK(lowered(":ask\ndialog \"d.dlg\"\nbad = 0\nif a = 1 then bad = 1\nif bad = 1 then message \"one\"\n"
                "if b = 1 then bad = 0\nif bad > 0 then goto ask\n") == "message-paths@message \"one\"");
  // A fact that is asked for again much later, and one that a variable hands on.
  CHECK(compared(":ask\ndialog \"d.dlg\"\nbad = 0\nif a > 5 then bad = 1\nif a < 8 then bad = bad + 2\n"
                 "if a = 6 then goto done\nif bad = 3 then message \"between\"\nif bad = 3 then goto ask\n"
                 "if a > 5 then message \"far\"\nif a > 5 then goto ask\n:done\n") == "both paths");
  CHECK(compared(":ask\ndialog \"d.dlg\"\nif a > 5 then goto far\nd = a\ngoto on\n:far\nd = 20 - a\n:on\n"
                 "if d > 12 then message \"d\"\nif d > 12 then goto ask\nif a >= 10 then goto ask\n") ==
        "both paths");
  CHECK(compared(":ask\ndialog \"d.dlg\"\nkind = 3\nif a < 0 then kind = 1\nif b < 0 then kind = 2\n"
                 "if kind <> 1 then goto two\nmessage \"a\"\ngoto ask\n:two\nif kind <> 2 then goto three\n"
                 "message \"b\"\ngoto ask\n:three\nif kind <> 3 then goto ask\n") == "both paths");
}

TEST_CASE("gibbs lower: a message that lets values pass is a hint or refused") {
  CHECK(lowered(":ask\ndialog \"d.dlg\"\nif a > 5 then message \"far\"\nif G < 54 then goto ask\n") ==
        "message-paths@message \"far\"");
  LowerProject hint(kFields, ":ask\ndialog \"d.dlg\"\nif a > 5 then message \"far\"\n");
  CHECK(hint.lowerChecks());
  CHECK(hint.findings() == "message-informs@message \"far\"");
  CHECK(hint.text(hint.cycle.checks) == "a<=5 -> L1\ncomment [far]\nL1:\n");
  LowerProject before(kFields, "message \"hello\"\n:ask\ndialog \"d.dlg\"\nif a > 5 then goto ask\n");
  CHECK(before.lowerChecks());
  CHECK(before.findings() == "message-informs@message \"hello\"");
  LowerProject computed(kFields, ":ask\ndialog \"d.dlg\"\nif a > 5 then stop \"far by\", a\n");
  CHECK(computed.lowerChecks());
  CHECK(computed.findings() == "message-computed@stop \"far by\", a");
  CHECK(computed.text(computed.cycle.checks) == "a<=5 -> L1\nalarm [far by]\nL1:\n");
}

TEST_CASE("gibbs lower: what only the CAM knows is refused where a check uses it") {
  const std::string unused =
      "p = callback_proc\nget_proc_data p, TOOL_NUM, t\nget_tool_data t, MTOOL_LENGTH, l\n"
      ":ask\ndialog \"d.dlg\"\n";
  CHECK(lowered(unused) == "");
  CHECK(lowered(unused + "if l < 5 then goto ask\n") == "cam-value@l");
  CHECK(lowered("get_tool_data 4, MTOOL_RADIUS, r\n:ask\ndialog \"d.dlg\"\nif a < r then goto ask\n") ==
        "cam-value@r");
  CHECK(lowered(":ask\ndialog \"d.dlg\"\na = callback_proc\n") == "cam-value@a = callback_proc");
  // Reached by no value: not refused.
  CHECK(lowered(unused + "x = 1\nif x = 2 then goto odd\ngoto done\n:odd\nif l < 5 then goto ask\n:done\n") ==
        "x = 1\n");
}

TEST_CASE("gibbs lower: refusals of the interpreter stay refusals") {
  CHECK(lowered(":ask\ndialog \"d.dlg\"\nif G < 54 or a > 1 then goto ask\n") ==
        "unverified-construct-run@G < 54 or a > 1");
  CHECK(lowered(":ask\ndialog \"d.dlg\"\nif bad > 0 then goto ask\n") == "read-before-set@bad");
  CHECK(lowered(":ask\ndialog \"d.dlg\"\nif a > 0 then bad = 1\nif bad > 0 then goto ask\n") ==
        "read-before-set@bad");
  CHECK(lowered(":ask\ndialog \"d.dlg\"\nif a > 0 then bad = 1\nif bad > 0 then goto ask\n",
                {"unset-zero"}) == "bad = 0\na<=0 -> L1\nbad = 1\nL1:\nbad<=0 -> L2\nalarm []\nL2:\n");
  CHECK(lowered("dialog \"d.dlg\"\nyesno \"sure?\", s\nif s = 0 then stop\n") == "needs-user@yesno");
  CHECK(lowered("dialog \"d.dlg\"\nif a < 0 then stop \"a\"\nyesno \"sure?\", s\nif s = 0 then stop\n",
                {"unchecked"}) == "a>=0 -> L1\nalarm [a]\nL1:\n");
  CHECK(lowered("dialog \"d.dlg\"\nif sin(a) > 0.5 then stop \"a\"\n") == "angle-unit-open@sin");
  CHECK(lowered("dialog \"d.dlg\"\n:a\nx = 1\ngoto a\n") == "goes-round-for-ever@goto a");
  CHECK(lowered("dialog \"d.dlg\"\ngoto nowhere\n") == "cannot-translate@nowhere");
  CHECK(lowered("dialog \"d.dlg\"\nx(1) = 2\n", {"array-round"}) == "cannot-translate@x");
  CHECK(lowered("dialog \"d.dlg\"\ncall \"main.mac\"\n") == "cannot-translate@\"main.mac\"");
  CHECK(lowered("dialog \"d.dlg\"\ncall \"CycleData.mac\"\n") == "call-too-deep@call \"CycleData.mac\"");
  // Under a condition it shows the dialog again.
  CHECK(lowered("dialog \"d.dlg\"\nif a > 5 then call \"CycleData.mac\"\n") == "a<=5 -> L1\nalarm []\nL1:\n");
  CHECK(lowered("on_error goto out\ndialog \"d.dlg\"\nif 1 / a > 2 then stop \"a\"\n:out\n") ==
        "cannot-translate@1 / a");
  CHECK(lowered("dialog \"d.dlg\"\nn = 3\nfor i = 1 to n\nn = 2\nnext i\n") == "unverified-construct-run@n");
  CHECK(lowered("dialog \"d.dlg\"\nfor i = 1 to 3 step a\nnext i\n") == "cannot-translate@a");
}

TEST_CASE("gibbs lower: a macro that calls itself ends at the limit") {
  LowerProject project(kFields, "dialog \"d.dlg\"\ncall \"deep\", a\n");
  project.files["deep.mac"] = "args v\nif v > 0 then call \"deep\", v - 1\n";
  project.limits.callDepth = 5;
  CHECK_FALSE(project.lowerChecks());
  CHECK(project.findings() == "call-too-deep@call \"deep\", v - 1");
}

TEST_CASE("gibbs lower: more paths than the limit allows are reported") {
  std::string checks = ":ask\ndialog \"d.dlg\"\nn = 0\n";
  for (int i = 1; i <= 14; ++i)
    checks += "if a > " + std::to_string(i) + " then n = n * 2 + b\n";
  LowerProject project(kFields, checks + "if n > 5 then goto ask\n");
  project.limits.paths = 1;
  CHECK_FALSE(project.lowerChecks());
  CHECK(project.findings() == "too-many-paths@");
}
