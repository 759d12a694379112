// Profiles that are known from published programs: what they take that others refuse, as lint and sim show
// it.
#include "stdlib/Control.h"
#include "stdlib/DataFiles.h"
#include "tests/GoldenRunner.h"
#include "tests/unit/DataFolder.h"

#include <doctest/doctest.h>

using namespace dotek;
using namespace dotek::tests;

namespace {

std::string linted(const std::string& text, const std::string& control) {
  const DataFolder folder;
  folder.write("o.nc", text);
  return runDotek({"lint", "o.nc", "--control", control}, folder.path()).out;
}

} // namespace

TEST_CASE("Haas NGC: forms that macros made for it hold") {
  const std::string text =
      "%\nO9101\nG103 P1\n(#5 = #6 (STATUS))\n#14=0.5\nWH[#11017 NE 0]DO1\n"
      "IF[#14 GT 30.]GOTO30\n#14=#14+0.5\nEND1\nIF[#30057.21]GOTO22\n#3000=80(OPTION IS OFF)\n"
      "N22 IF[#20009 EQ 0]#14=#14/25.4\n#168=ATAN[#14/2.]\n#10201=#168\nG103\nM99\n"
      "N30 #3000=92(SURFACE)\n%\n";
  CHECK(linted(text, "haas-ngc") == "");
  const std::string fanuc = linted(text, "fanuc-31i-b");
  for (const char* code : {"short-word", "variable-number-form", "then-missing", "syntax-error"})
    CHECK(fanuc.find(code) != std::string::npos);
}

TEST_CASE("Haas NGC: the second names of variables are known, and a run that writes one ends there") {
  const DataFolder folder;
  folder.write("o.nc", "O1\n#10556=1.\nM30\n");
  CHECK(linted("O1\n#10556=1.\n#15581=2.\n#701=#30003.036\nM30\n", "haas-ngc").find("unknown") ==
        std::string::npos);
  const CommandResult run = runDotek({"sim", "o.nc", "--control", "haas-ngc"}, folder.path());
  CHECK(run.status != 0);
  CHECK(run.err.find("inconclusive") != std::string::npos);
}

TEST_CASE("Mitsubishi M8: what published programs show") {
  const std::optional<stdlib::Control> control = stdlib::Control::load(stdlib::DataFiles(), "mitsubishi-m8");
  REQUIRE(control);
  CHECK(control->programLast == 99999999);
  CHECK(control->variables.toolGeometry == 2000);
  CHECK(control->variables.toolGeometryToo == 10000);
  CHECK(control->variables.toolWearToo == 11000);
  CHECK(control->alarms.empty());
  CHECK_FALSE(control->window);
  REQUIRE(control->find('G', 540) != nullptr);
  CHECK(control->find('G', 540)->group == 12); // #4012 holds it
  CHECK(
      linted(
          "O900003\nIF[#4012 LT 54]GOTO8\n#900018=#5063-#5083\n#21=#901062-#5021\nG91 G53 G0 X#21\nG90\nM99\n"
          "N8 #3000=121(WORK SYSTEM)\n",
          "mitsubishi-m8")
          .find("unknown") == std::string::npos);
}

TEST_CASE("a control of one's own may take short words") {
  const DataFolder folder;
  folder.write("data/controls/ours.toml",
               "schema = 1\ntitle = \"Ours\"\nextends = \"fanuc-0i-md\"\n[language]\n"
               "abbreviated_words = true\ngrade = \"observed\"\nsource = \"our machine\"\n");
  folder.write("o.nc", "O1\n#1=1\nWH[#1 LT 3]DO1\n#1=#1+1\nEN1\nM30\n");
  const CommandResult run = runDotek({"sim", "o.nc", "--data", "data", "--control", "ours"}, folder.path());
  CHECK(run.status == 0);
  CHECK(run.out.find("end\n") != std::string::npos);
}

TEST_CASE("lint: a program whose last call ends the run has its normal end there") {
  const DataFolder folder;
  const auto found = [&](const std::string& end) {
    folder.write("o.nc",
                 "%\nO1010\nIF[#100 EQ 1]GOTO3\nM98 P8004\nN3 #3000=15(NOT BY HAND)\nO8004\n#100=2\n" + end +
                     "\n%\n");
    return runDotek({"lint", "o.nc", "--select", "no-normal-end"}, folder.path()).out;
  };
  CHECK(found("M30") == "");
  CHECK(found("M99").find("[no-normal-end]") != std::string::npos);
}
