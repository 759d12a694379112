// The part that `sim` makes of the touches of a cycle.
#include "tests/GoldenRunner.h"
#include "tests/TestFolder.h"

#include <doctest/doctest.h>
#include <string>

using namespace dotek::tests;

namespace {

CommandResult simulated(const std::string& touches) {
  const TestFolder folder("dotek-made-part");
  folder.write("steps.cycle", "cycle steps \"Steps\"\nresult run : length\nspindle off\nprobe on\n" +
                                  touches + "protected move to start\nprobe off\nrun = high.at - low.at\n");
  return runDotek(splitArguments("sim steps.cycle"), folder.path());
}

bool holds(const CommandResult& result, const std::string& text) {
  return (result.out + result.err).find(text) != std::string::npos;
}

} // namespace

TEST_CASE("made part: the face of a lower touch ends below the way of the upper one") {
  const CommandResult down =
      simulated("touch x by 16 mm -> high\nprotected move by z -4 mm\ntouch x by 12 mm -> low\n");
  CAPTURE(down.err);
  CHECK(down.status == 0);
  CHECK(holds(down, "result run 4.000000"));
  CHECK_FALSE(holds(down, "edge-touched"));
  const CommandResult aside =
      simulated("touch y by 16 mm -> high\nprotected move by x -5 mm\ntouch y by 12 mm -> low\n");
  CHECK(holds(aside, "result run 4.000000"));
}

TEST_CASE("made part: where no part has both faces the run asks for one") {
  const CommandResult below = simulated("touch z by -5 mm -> high\ntouch z by -13 mm -> low\n");
  CAPTURE(below.err);
  CHECK(below.status == 1);
  CHECK(holds(below, "steps.cycle:6:1: error: "));
  CHECK(holds(below, "[no-nominal-part]"));
  const CommandResult close =
      simulated("touch x by 16 mm -> high\nprotected move by z -2 mm\ntouch x by 12 mm -> low\n");
  CHECK(holds(close, "[no-nominal-part]"));
  // Without a probe that is on the part is not what is wrong.
  CHECK_FALSE(
      holds(simulated("probe off\ntouch x by 5 mm -> high\ntouch x by 9 mm -> low\n"), "no-nominal-part"));
}

TEST_CASE(
    "cycle: a touch that is written as a value, a wear as length, and an offset that no control can set") {
  const TestFolder folder("dotek-cycle-remedies");
  const auto said = [&](const std::string& command, const std::string& body) {
    folder.write("one.cycle", "cycle one \"One\"\nspindle off\nprobe on\n" + body + "probe off\n");
    const CommandResult result = runDotek(splitArguments(command), folder.path());
    return result.out + result.err;
  };
  CHECK(said("lint one.cycle", "left = touch x by 5 mm\n").find("write `touch x by 5 mm -> left`") !=
        std::string::npos);
  CHECK(said("lint one.cycle", "set tool 3 wear 0.03 mm\n").find("length_wear") != std::string::npos);
  const std::string unset =
      said("convert one.cycle --to fanuc --control fanuc-6m --probe-macros inspection-plus",
           "touch x by 5 mm -> side\nplace = side.at\nset G54: place becomes x 0 mm\n");
  CHECK(unset.find("[offset-write-unsafe]") != std::string::npos);
  CHECK(unset.find("macro set of the source") == std::string::npos);
}

TEST_CASE(
    "cycle: a division by a measured value is reported where it stands, on a control that computes nothing") {
  const TestFolder folder("dotek-cycle-division");
  folder.write("one.cycle", "cycle one \"One\"\nparameter depth : length = 5 mm\nresult slope : ratio\n"
                            "spindle off\nprobe on\ntouch x by 10 mm -> right\ntouch x by -10 mm -> left\n"
                            "probe off\ngap = right.at - left.at\nslope = 1 + depth / gap\n"
                            "if slope > 2 then\n  alarm \"Too steep\"\nend\n");
  const CommandResult result = runDotek(
      splitArguments("convert one.cycle --to mikroprog --control mikroprog-mill --host tool_radius=3 "
                     "--host clearance=50 --host overtravel=5 --host return_feed=500 --host start_x=0 "
                     "--host start_y=0"),
      folder.path());
  CAPTURE(result.err);
  CHECK(holds(result, "one.cycle:10:13: error: "));
  CHECK_FALSE(holds(result, "one.cycle:6:"));
}
