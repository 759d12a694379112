// A program of a cycle is called by those who break what it demands, and with what its checks refuse.
#include "tests/Process.h"

#include <doctest/doctest.h>

using namespace dotek::tests;

namespace {

constexpr const char* kGroove = R"TXT(cycle groove "Groove in z"

parameter wide   : length               "Width of the groove"  require wide > 2 * ball_radius "Groove is narrow"
parameter below  : length = 4 mm        "Depth of the touches" require below > 0 mm
parameter slack  : length optional      "Largest deviation of the width"
parameter system : work_offset optional "Work offset that gets the middle"
result    width  : length               "Width found"
result    middle : length               "Middle of the groove"

spindle off
coolant off
probe on
protected move by z -below
touch x by wide / 2 -> right
touch x by -wide / 2 -> left
protected move to start
probe off
width = right.at - left.at
middle = (right.at + left.at) / 2
if given slack and abs(width - wide) > slack then
  alarm "Width out of tolerance"
end
if given system then
  set system: middle becomes x 0 mm
end
)TXT";

constexpr const char* kFlags = " --to fanuc --control fanuc-31i-b --probe-macros inspection-plus "
                               "--result width=#600,middle=#601 ";

} // namespace

TEST_CASE("verify cycles: a demand on the caller or a check that is lost is seen") {
  const ProcessFolder folder;
  folder.write("groove.cycle", kGroove);
  REQUIRE(folder.run(std::string("dotek convert groove.cycle") + kFlags + "-o whole.nc").status == 0);
  const std::string verify =
      std::string("dotek verify groove.cycle") + kFlags + "--cases 60 --allow-edits --translation ";
  const ShellResult whole = folder.run(verify + "whole.nc");
  CHECK_MESSAGE(whole.status == 0, whole.out << whole.err);

  struct Damage {
    const char* edit;
    const char* said;
  };
  for (const Damage& one :
       {Damage{"/THEN #3000=.*(NOT METRIC)/d", "called with G20 in force"},
        Damage{"/THEN #3000=.*(TOOL LENGTH NOT ACTIVE)/d", "called with G49 in force"},
        Damage{"/THEN #3000=.*(ROTATION ACTIVE)/d", "called with G68"},
        Damage{"/THEN #3000=.*(ARGUMENT A MISSING)/d", "called without A (wide)"},
        Damage{"/THEN #3000=.*(BELOW OUT OF RANGE)/d", "called with below"},
        Damage{"/THEN #3000=.*(GROOVE IS NARROW)/d", "the checks of the cycle reject the values"},
        Damage{"/ GT 59.*WORK OFFSET NOT/d", "it is no work offset"},
        Damage{"/ NE FIX.*WORK OFFSET/d", "it is no work offset"}}) {
    CAPTURE(one.edit);
    const ShellResult edited = folder.run(std::string("sed '") + one.edit +
                                          "' whole.nc >less.nc; cmp -s whole.nc less.nc && echo same");
    REQUIRE(edited.out.empty());
    const ShellResult result = folder.run(verify + "less.nc");
    CHECK_MESSAGE(result.status == 1, result.out << result.err);
    CHECK_MESSAGE((result.out + result.err).find(one.said) != std::string::npos, result.out << result.err);
  }
}

TEST_CASE("verify cycles: a demand of the program that a fragment carries is seen, too") {
  const ProcessFolder folder;
  folder.write("groove.cycle", kGroove);
  const std::string flags = std::string(" --to fusion --host approach_feed=1000 --control fanuc-31i-b ") +
                            "--probe-macros inspection-plus --result width=#600,middle=#601 ";
  REQUIRE(folder.run("dotek convert groove.cycle" + flags + "-o whole.js").status == 0);
  const std::string verify = "dotek verify groove.cycle" + flags + "--cases 20 --allow-edits --translation ";
  const ShellResult whole = folder.run(verify + "whole.js");
  CHECK_MESSAGE(whole.status == 0, whole.out << whole.err);
  for (const char* const lost : {"NOT METRIC", "ROTATION ACTIVE", "ARGUMENT A MISSING"}) {
    CAPTURE(lost);
    const ShellResult edited = folder.run(std::string("sed '/THEN #3000=.*") + lost +
                                          "/d' whole.js >less.js; cmp -s whole.js less.js && echo same");
    REQUIRE(edited.out.empty());
    const ShellResult result = folder.run(verify + "less.js");
    CHECK_MESSAGE(result.status == 1, result.out << result.err);
    CHECK_MESSAGE((result.out + result.err).find("called with") != std::string::npos,
                  result.out << result.err);
  }
}

// The room in the bore is asked by the cycle that is called, the offset by the program before all else.
TEST_CASE("verify cycles: which of two checks stops the caller first is open") {
  const ProcessFolder folder;
  folder.write("both.cycle", R"TXT(cycle both "Bore, then its tool"
parameter wide   : length      "Bore"
parameter cutter : tool_offset "Tool"
spindle off
probe on
call bore diameter = wide -> hole
probe off
set tool cutter radius_wear (hole.size - wide) / 2
)TXT");
  const std::string flags = " --to fanuc --control fanuc-31i-b --probe-macros inspection-plus ";
  const std::string verify = "dotek verify both.cycle" + flags +
                             "--value cutter=0 --value wide=0 --value approach_feed=640 --value start_x=0 "
                             "--value start_y=0 --value start_z=0 --value tool_radius=2 --active-system 54 "
                             "--replay ";
  const ShellResult both = folder.run(verify);
  CHECK_MESSAGE(both.out.find("DIFFERS") == std::string::npos, both.out << both.err);
  // Without the check of the offset the program goes on to that of the bore, and without both it moves.
  REQUIRE(folder
              .run("dotek convert both.cycle" + flags +
                   "-o whole.nc && sed '/TOOL OFFSET NOT/d;/NO ROOM/d' "
                   "whole.nc >less.nc")
              .status == 0);
  const ShellResult less = folder.run(verify + "--allow-edits --translation less.nc");
  CHECK_MESSAGE(less.out.find("DIFFERS") != std::string::npos, less.out << less.err);
}
