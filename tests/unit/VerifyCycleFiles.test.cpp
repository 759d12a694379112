// A file of the cycle language beside what convert writes of it: both do the same, and a change of the
// program is seen.
#include "driver/Driver.h"
#include "tests/Draws.h"
#include "tests/GoldenRunner.h"
#include "tests/TestFolder.h"

#include <algorithm>
#include <array>
#include <doctest/doctest.h>
#include <string>
#include <vector>

using namespace dotek;
using namespace dotek::tests;

namespace {

std::string libraryPath(const std::string& name) {
  return (root() / "stdlib/cycles" / (name + ".cycle")).string();
}

driver::VerifyOptions optionsOf(const std::string& path, const std::string& set,
                                const std::string& control = "") {
  driver::VerifyOptions out;
  out.inputs = {path};
  out.to = "fanuc";
  out.control = control;
  out.probeMacros = set;
  out.jobs = 1;
  if (set == "easyprobe" || control == "fanuc-31i-b") {
    out.common.probeCodes.on = "M97"; // no profile says it of these
    out.common.probeCodes.off = "M96";
  }
  return out;
}

std::string said(const driver::Outcome& outcome) {
  return outcome.output + renderText(outcome.diagnostics, outcome.sources, 0);
}

bool says(const driver::Outcome& outcome, std::string_view code) {
  const auto& all = outcome.diagnostics.all();
  return std::any_of(all.begin(), all.end(), [&](const Diagnostic& one) { return one.code == code; });
}

struct Planted {
  const char* was;
  const char* is;
};

// `is` in the place of the last `was` of what convert writes.
driver::Outcome verifyPlanted(driver::VerifyOptions options, const Planted& planted) {
  driver::ConvertOptions convert;
  static_cast<targets::TranslationOptions&>(convert) = options;
  const driver::Outcome written = driver::convert(convert);
  REQUIRE_MESSAGE(written.files.size() == 1, said(written));
  std::string text = written.files.front().text;
  const std::size_t at = text.rfind(planted.was);
  REQUIRE_MESSAGE(at != std::string::npos, text);
  text.replace(at, std::string_view(planted.was).size(), planted.is);
  const TestFolder folder("dotek-planted");
  options.allowEdits = true; // the cases alone are to show it
  options.translation = folder.write("O8000.nc", text);
  return driver::verify(options);
}

} // namespace

TEST_CASE("verify cycles: the library does on a control what it means") {
  for (const char* const name :
       {"bore", "bore-depth", "surface-x", "surface-y", "surface-z", "web-x", "channel-y", "mean-touch-z",
        "corner-inner", "corner-outer", "rectangle-inside", "step-height", "edge-angle-x", "judge",
        "surface-angled", "bore-3", "boss-angled"})
    for (const char* const set : someOf<const char*>({"inspection-plus", "dotek"})) {
      CAPTURE(name);
      CAPTURE(set);
      driver::VerifyOptions options = optionsOf(libraryPath(name), set);
      options.cases = draws(20U, 3U);
      const driver::Outcome outcome = driver::verify(options);
      CHECK_MESSAGE(outcome.status == 0, said(outcome));
      CHECK_MESSAGE(outcome.output.starts_with("AGREES"), outcome.output);
    }
}

TEST_CASE("verify cycles: a touch that goes on where nothing is found is tried without its surface") {
  const TestFolder folder("dotek-miss");
  const std::string path = folder.write("edges.cycle", R"(cycle edges "Edges that may not be there"

parameter direction : angle  "Direction of the first"
parameter way       : length "Way"                    require way > 6 mm
result    found     : count  "How many are there"

probe on
found = 2
touch along x cos(direction), y sin(direction) by way -> one else
  found = found - 1
end
touch x by way -> two else
  found = found - 1
end
probe off
)");
  driver::VerifyOptions options = optionsOf(path, "dotek", "fanuc-31i-b");
  options.results = {{"found", "#600"}};
  options.cases = 60;
  const driver::Outcome sound = driver::verify(options);
  CHECK_MESSAGE(sound.output.starts_with("AGREES"), said(sound));
  for (const Planted& planted :
       {Planted{" M1\n", "\n"}, Planted{"IF[#149 NE 0.]GOTO", "IF[#149 EQ 0.]GOTO"}}) {
    CAPTURE(planted.was);
    const driver::Outcome found = verifyPlanted(options, planted);
    CHECK_MESSAGE(found.output.starts_with("DIFFERS"), said(found));
  }
}

TEST_CASE("verify cycles: the error of a touch along a direction, whatever its parts are") {
  const TestFolder folder("dotek-along");
  const std::string path = folder.write("along.cycle", R"(cycle along "Along"

parameter part_x, part_y : ratio  "Parts of the direction"
parameter way            : length "Way"                   require way > 6 mm
result    away, at_x, high : length "What is found"
require square(part_x) + square(part_y) > 0.01

probe on
touch along x part_x, y part_y by way -> edge
probe off
away = edge.error
at_x = edge.at_x
high = edge.at_z - ball_radius
)");
  for (const char* const set : {"inspection-plus", "dotek"}) {
    CAPTURE(set);
    driver::VerifyOptions options = optionsOf(path, set, "fanuc-31i-b");
    options.results = {{"away", "#600"}, {"at_x", "#601"}, {"high", "#602"}};
    options.cases = 60;
    const driver::Outcome sound = driver::verify(options);
    CHECK_MESSAGE(sound.output.starts_with("AGREES"), said(sound));
    const driver::Outcome planted = verifyPlanted(options, {"A#", "A-#"});
    CHECK_MESSAGE(planted.output.starts_with("DIFFERS"), said(planted));
  }
}

TEST_CASE("verify cycles: the tool offsets that both sides leave") {
  for (const char* const control : {"fanuc-31i-b", "haas-ngc"}) {
    CAPTURE(control);
    driver::VerifyOptions options = optionsOf(libraryPath("tool-length"), "inspection-plus", control);
    options.cases = 40;
    const driver::Outcome sound = driver::verify(options);
    CHECK_MESSAGE(sound.output.starts_with("AGREES"), said(sound));
  }
  driver::VerifyOptions options = optionsOf(libraryPath("tool-length"), "dotek", "fanuc-31i-b");
  options.cases = 40;
  for (const Planted& planted : {Planted{"#[2000+#20]=0.", "#[2001+#20]=0."}, // the wear stays
                                 Planted{"#[2200+#20]=", "#[2201+#20]="},     // another tool
                                 Planted{"#[2200+#20]=", "#[2000+#20]="}}) {  // nothing is left of it
    CAPTURE(planted.was);
    const driver::Outcome found = verifyPlanted(options, planted);
    CHECK_MESSAGE(found.output.starts_with("DIFFERS"), said(found));
  }
}

TEST_CASE("verify cycles: the angle of a ratio, on a control that has ATAN of two values only") {
  const TestFolder folder("dotek-ratio");
  const std::string path = folder.write("slope.cycle", R"(cycle slope "Slope"
parameter away : length = 10 mm
result turn : angle
spindle off
probe on
touch x by 5 mm -> side
probe off
turn = 90 deg - atan(side.error / away) * 2
)");
  for (const char* const control : {"haas-ngc", "fanuc-0i-md"}) {
    CAPTURE(control);
    driver::VerifyOptions options = optionsOf(path, "inspection-plus", control);
    options.results = {{"turn", "#600"}};
    options.cases = 40;
    const driver::Outcome sound = driver::verify(options);
    CHECK_MESSAGE(sound.output.starts_with("AGREES"), said(sound));
    const driver::Outcome found = verifyPlanted(options, {"=90.-", "=90.+"});
    CHECK_MESSAGE(found.output.starts_with("DIFFERS"), said(found));
  }
}

TEST_CASE("verify cycles: a stop and values for a later run") {
  driver::VerifyOptions options = optionsOf(libraryPath("calibrate-turn"), "dotek", "fanuc-31i-b");
  options.cases = 20;
  CHECK(says(driver::verify(options), "cycle-statement"));
  options.results = {{"probe_offset_x", "#560"}, {"probe_offset_y", "#561"}};
  const driver::Outcome sound = driver::verify(options);
  CHECK_MESSAGE(sound.output.starts_with("AGREES"), said(sound));
  const driver::Outcome found = verifyPlanted(options, {"#561=", "#562="});
  CHECK_MESSAGE(found.output.starts_with("DIFFERS"), said(found));
}

// Its middle is computed from contacts, whatever the values are.
TEST_CASE("verify cycles: a cycle that no values make a program of is refused as such") {
  driver::VerifyOptions options = optionsOf(libraryPath("bore"), "", "mikroprog-mill");
  options.to = "mikroprog";
  options.probeMacros.reset();
  options.cases = 5;
  options.common.host = {{"approach_feed", "1000"}, {"overtravel", "5"}, {"start_x", "0"},
                         {"start_y", "0"},          {"start_z", "10"},   {"retract", "20"}};
  const driver::Outcome outcome = driver::verify(options);
  CHECK_MESSAGE(says(outcome, "conversion-refused"), said(outcome));
  CHECK(said(outcome).find("computes nothing with what was measured") != std::string::npos);
}

// A macro that takes a travel as its whole search, as EasyProbe's, and needs no work offset to set.
TEST_CASE("verify cycles: a travel that is a macro's whole search goes on beyond the surface") {
  const TestFolder folder("dotek-whole-search");
  std::string set = readAll(root() / "stdlib/macros/easyprobe.toml");
  for (const std::string_view needs : {std::string_view(", point = true, required = true"),
                                       std::string_view("role = \"nominal\", axis = \"X\", required = true")})
    for (std::size_t at = 0; (at = set.find(needs, at)) != std::string::npos; ++at)
      set.erase(at + needs.size() - 17, 17); // ", required = true"
  folder.write("macros/travel.toml", set);
  const auto written = [&](const std::string& travel) {
    return folder.write("face.cycle", "cycle face \"Face\"\n\nparameter way : length = 12 mm letter X\n\n"
                                      "spindle off\nprobe on\ntouch x by " +
                                          travel + "\nprobe off\n");
  };
  driver::ConvertOptions options;
  options.inputs = {written("way")};
  options.common.data = {folder.path().string()};
  options.to = "fanuc";
  options.control = "fanuc-0i-md";
  options.probeMacros = "travel";
  driver::Outcome outcome = driver::convert(options);
  REQUIRE_MESSAGE(outcome.status == 0, said(outcome));
  CHECK_MESSAGE(outcome.output.find("X[#24*[1.+10./ABS[#24]]]") != std::string::npos, outcome.output);
  options.common.host = {{"overtravel", "4"}};
  outcome = driver::convert(options);
  CHECK_MESSAGE(outcome.output.find("X[#24*[1.+4./ABS[#24]]]") != std::string::npos, outcome.output);
  options.inputs = {written("-3 mm")};
  outcome = driver::convert(options);
  CHECK_MESSAGE(outcome.output.find("X-7.") != std::string::npos, outcome.output);
  options.inputs = {written("way")};
  options.common.set = {{"way", "0"}};
  outcome = driver::convert(options);
  CHECK(outcome.status == 1);
  CHECK_MESSAGE(said(outcome).find("a travel of 0 has no direction") != std::string::npos, said(outcome));
  driver::VerifyOptions verify = optionsOf(written("way"), "travel", "fanuc-0i-md");
  verify.common.data = options.common.data;
  verify.cases = 9; // none at an edge
  outcome = driver::verify(verify);
  CHECK_MESSAGE(outcome.output.starts_with("AGREES"), said(outcome));
}

// No part has so many faces; a probe that meets nothing would be the wrong reason.
TEST_CASE("verify cycles: more surfaces than a part can have are the reason") {
  const TestFolder folder("dotek-many-surfaces");
  const std::string path = folder.write("stairs.cycle", "cycle stairs \"Stairs\"\n\nspindle off\nprobe on\n"
                                                        "repeat 230 times\n  touch x by 10 mm -> wall\n"
                                                        "  move by y 30 mm\nend\nprobe off\n");
  driver::VerifyOptions options = optionsOf(path, "dotek");
  options.cases = 2;
  const driver::Outcome outcome = driver::verify(options);
  CHECK_MESSAGE(says(outcome, "no-values-found"), said(outcome));
  CHECK_MESSAGE(said(outcome).find("of the 230 surfaces that it touches") != std::string::npos,
                said(outcome));
}

// Where the ball begins within a hundredth of the wall, macros take the stylus for deflected.
TEST_CASE("verify cycles: a touch without a way says nothing") {
  const TestFolder folder("dotek-no-way");
  const std::string path = folder.write(
      "near.cycle", "cycle near \"Near\"\n\nspindle off\nprobe on\ntouch x by 3.001 mm -> wall\nprobe off\n");
  driver::VerifyOptions options = optionsOf(path, "dotek");
  options.cases = 5;
  options.common.host = {{"tool_radius", "3"}};
  options.partError = std::array<double, 4>{0, 0, 0, 0};
  const driver::Outcome outcome = driver::verify(options);
  CHECK_MESSAGE(says(outcome, "no-values-found"), said(outcome));
  CHECK(said(outcome).find("the ball touches where a touch begins") != std::string::npos);
}

// The text of our own macros is none of this control's; a program that calls none of them is.
TEST_CASE("verify cycles: a cycle that computes agrees on a control without our macros") {
  driver::VerifyOptions options = optionsOf(libraryPath("judge"), "dotek", "fanuc-6m");
  options.common.probeCodes.on = "M97";
  options.common.probeCodes.off = "M96";
  options.cases = 5;
  const driver::Outcome outcome = driver::verify(options);
  CHECK_MESSAGE(outcome.output.starts_with("AGREES"), said(outcome));
}

TEST_CASE("verify cycles: a change of the program is a difference") {
  driver::VerifyOptions options = optionsOf(libraryPath("bore"), "inspection-plus");
  options.cases = draws(60U, 20U);
  options.results = {{"size", "#520"}, {"centre_x", "#521"}};
  const driver::Outcome sound = driver::verify(options);
  REQUIRE_MESSAGE(sound.status == 0, said(sound));
  for (const Planted& planted : {
           Planted{"P9811 X[#27+#7/2.]", "P9811 X[#27+#7]"},        // expects the wall elsewhere
           Planted{"P9811 X[#27+#7/2.]", "P9811 Y[#14+#7/2.]"},     // another axis
           Planted{"G65 P9810 X[[#", "G65 P9810 X[1.+[#"},          // beside the middle
           Planted{"G65 P9832\n", ""},                              // the probe stays off
           Planted{"M5\n", ""},                                     // the spindle turns
           Planted{"THEN #26=0.", "THEN #26=1."},                   // another default
           Planted{"GT #11]", "LT #11]"},                           // the tolerance the other way
           Planted{"#[5221+[#19-54]*20]=", "#[5222+[#19-54]*20]="}, // the offset of another axis
           Planted{"#520=", "#522="},                               // a result elsewhere
       }) {
    CAPTURE(planted.was);
    CAPTURE(planted.is);
    const driver::Outcome outcome = verifyPlanted(options, planted);
    CHECK_MESSAGE(outcome.status == 1, said(outcome));
    CHECK_MESSAGE(outcome.output.starts_with("DIFFERS"), said(outcome));
  }
}

TEST_CASE("verify cycles: results go to variables that the caller names") {
  driver::VerifyOptions options = optionsOf(libraryPath("bore"), "inspection-plus");
  options.cases = 8;
  options.results = {{"siz", "#520"}};
  CHECK(says(driver::verify(options), "cycle-result-unknown"));
  for (const char* const wrong : {"#0", "size", "520.5", "#-1"}) {
    options.results = {{"size", wrong}};
    CHECK(says(driver::verify(options), "cycle-result-number"));
  }
  options.results = {{"size", "#520"}, {"centre_x", "520"}};
  CHECK(says(driver::verify(options), "cycle-result-number"));
  options.results = {{"size", "#33"}}; // a local
  CHECK(says(driver::verify(options), "store-variable"));
}

TEST_CASE("verify cycles: what a cycle has measured is left before its alarm, too") {
  const TestFolder folder("dotek-alarm");
  const std::string path = folder.write("step.cycle", R"(cycle step "Step with a limit"

parameter limit : length "Largest height" range 1 mm to 20 mm

result height : length "Height over the start"
result verdict : flag "Within the limit"

spindle off
probe on
touch z by -10 mm -> top
probe off
height = top.error
if abs(height) > limit / 10 then
  alarm "Height out of limits"
end
verdict = yes
)");
  driver::VerifyOptions options = optionsOf(path, "inspection-plus");
  options.cases = draws(60U, 10U);
  options.results = {{"height", "#560"}, {"verdict", "#561"}};
  const driver::Outcome outcome = driver::verify(options);
  CHECK_MESSAGE(outcome.status == 0, said(outcome));
  driver::ConvertOptions convert;
  static_cast<targets::TranslationOptions&>(convert) = options;
  const driver::Outcome written = driver::convert(convert);
  REQUIRE_MESSAGE(written.files.size() == 1, said(written));
  const std::string& text = written.files.front().text;
  const std::size_t limit = text.rfind("HEIGHT OUT OF LIMITS)");
  REQUIRE_MESSAGE(limit != std::string::npos, text);
  CHECK_MESSAGE(text.find("#560=") < limit, text);
  CHECK_MESSAGE(text.find("#561=") > limit, text); // it has no value there
  CHECK_MESSAGE(text.find("#560=", limit) != std::string::npos, text);
}

TEST_CASE("convert: the call in the header of a cycle passes the checks of the cycle") {
  const TestFolder folder("dotek-example");
  const std::string path = folder.write("slot.cycle", R"(cycle slot "Slot"

parameter width : length "Width"          require width > 2 * ball_radius + 1 mm
parameter depth : length "Depth"          range 2 mm to 40 mm
parameter side  : angle  "Which side"     range 30 deg to 60 deg

result size : length "Width as measured"

spindle off
probe on
touch x by width / 2 -> right
touch x by -width / 2 -> left
probe off
size = right.at - left.at + depth * sin(side) * 0
)");
  driver::ConvertOptions options;
  options.inputs = {path};
  options.to = "fanuc";
  options.probeMacros = "inspection-plus";
  options.results = {{"size", "#560"}};
  const driver::Outcome written = driver::convert(options);
  REQUIRE_MESSAGE(written.files.size() == 1, said(written));
  const std::string& text = written.files.front().text;
  const std::size_t call = text.find("(CALL: G65 P8000 ");
  REQUIRE_MESSAGE(call != std::string::npos, text);
  // Called as the header says, the program goes on to the touch that finds nothing.
  const std::string file = folder.write("O8000.nc", text);
  driver::SimOptions sim;
  sim.program = file;
  sim.setup.tool = 1;
  sim.setup.length = 80;
  sim.setup.call = text.substr(call + 17, text.find(')', call) - call - 17);
  const driver::Outcome run = driver::sim(sim);
  CHECK_MESSAGE(run.output.find("OUT OF RANGE") == std::string::npos, run.output);
  CHECK_MESSAGE(said(run).find("P9811") != std::string::npos, said(run));
}

TEST_CASE("verify cycles: convert --verify writes what agrees") {
  driver::ConvertOptions options;
  options.inputs = {libraryPath("surface-x")};
  options.to = "fanuc";
  options.probeMacros = "inspection-plus";
  options.verify = true;
  const driver::Outcome outcome = driver::convert(options);
  CHECK_MESSAGE(outcome.status == 0, said(outcome));
  CHECK(outcome.files.size() == 1);
  CHECK(says(outcome, "verified"));
}

TEST_CASE("verify cycles: a replay runs the case that was found, with what it left out") {
  driver::VerifyOptions options = optionsOf(libraryPath("surface-x"), "inspection-plus");
  options.cases = 40;
  const driver::Outcome outcome = verifyPlanted(options, {"THEN #4=0.", "THEN #4=2."});
  REQUIRE_MESSAGE(outcome.status == 1, said(outcome));
  // The argument is left out in the case that shows it, so its replay does not give it.
  const std::string text = said(outcome);
  const std::size_t at = text.find("replay: ");
  REQUIRE(at != std::string::npos);
  const std::string replay = text.substr(at, text.find('\n', at) - at);
  CHECK(replay.find("at_x") == std::string::npos);
  CHECK(replay.find("system=") != std::string::npos);
}
