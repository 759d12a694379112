// What a cycle does only where a measured value lies between two limits: verify comes there, and names what
// it does not come to.
#include "tests/Process.h"

#include <doctest/doctest.h>

using namespace dotek::tests;

namespace {

// Between `ignored` and `most` the tool is corrected; beyond that it is scrap.
constexpr const char* kWear = R"TXT(cycle wear "Bore, then the wear of its tool"

parameter wide   : length            "Nominal diameter" require wide > 2 * ball_radius + 2 mm "Bore is narrow"
parameter most   : length = 0.05 mm  "Largest deviation"
parameter low    : length = 4 mm     "Depth of the touches" require low > 0 mm
parameter cutter : tool_offset       "Finishing tool"
result    size   : length            "Diameter found"
result    scrap  : flag              "It is out of tolerance"

spindle off
probe on
protected move by z -low
touch x by wide / 2 -> right
touch x by -wide / 2 -> left
protected move to start
probe off
size = right.at - left.at
scrap = no
if abs(size - wide) > most then
  scrap = yes
else if abs(size - wide) > 0.004 mm then
  set tool cutter radius_wear cutter.radius_wear - (size - wide) / 2
end
)TXT";

constexpr const char* kFlags = " --to fanuc --control fanuc-31i-b --probe-macros inspection-plus "
                               "--result size=#600,scrap=#601 ";

} // namespace

TEST_CASE("verify cycles: what is done between two limits of a measured value is compared") {
  const ProcessFolder folder;
  folder.write("wear.cycle", kWear);
  REQUIRE(folder.run(std::string("dotek convert wear.cycle") + kFlags + "-o whole.nc").status == 0);
  const std::string verify =
      std::string("dotek verify wear.cycle") + kFlags + "--cases 40 --allow-edits --translation ";
  const ShellResult whole = folder.run(verify + "whole.nc");
  CHECK_MESSAGE(whole.status == 0, whole.out << whole.err);
  CHECK_MESSAGE(whole.err.find("not reached in any case") == std::string::npos, whole.err);

  struct Damage {
    const char* what;
    const char* edit;
  };
  for (const Damage& one :
       {Damage{"the sign of the correction", "s/-\\[#14-#1\\]\\/2\\./+[#14-#1]\\/2./"},
        Damage{"twice the correction", "s/\\[#14-#1\\]\\/2\\./[#14-#1]/"},
        Damage{"another offset", "s/^#\\[12000+/#[12001+/"},
        Damage{"the geometry in place of the wear", "s/^#\\[12000+/#[13000+/"},
        Damage{"the null band ten times", "s/LE 0\\.004\\]/LE 0.04]/"},
        Damage{"the two limits swapped", "s/LE #2\\]/LE A]/;s/LE 0\\.004\\]/LE #2]/;s/LE A\\]/LE 0.004]/"},
        Damage{"the verdict", "s/^#12=1\\.$/#12=0./"}}) {
    CAPTURE(one.what);
    const ShellResult edited = folder.run(std::string("sed '") + one.edit +
                                          "' whole.nc >less.nc; cmp -s whole.nc less.nc && cat whole.nc");
    REQUIRE_MESSAGE(edited.out.empty(), edited.out);
    const ShellResult result = folder.run(verify + "less.nc");
    CHECK_MESSAGE(result.status == 1, result.out << result.err);
    CHECK_MESSAGE((result.out + result.err).find("with the part off") != std::string::npos,
                  result.out << result.err);
  }
}

TEST_CASE("verify cycles: what no case comes to is named, each part once") {
  const ProcessFolder folder;
  folder.write("far.cycle", R"TXT(cycle far "Face"
parameter way  : length = 8 mm "Way" require way > 0 mm "Way is not above 0"
result    size : length        "Found"
spindle off
probe on
touch x by way -> face
probe off
size = face.at
if face.error > 5 mm then
  stop "Part is far away"
  size = 0 mm
end
if face.error > 6 mm then
  alarm "Too far"
end
)TXT");
  const ShellResult result = folder.run("dotek verify far.cycle --to fanuc --control fanuc-31i-b "
                                        "--probe-macros inspection-plus --result size=#600 --cases 20");
  CHECK_MESSAGE(result.status == 0, result.out << result.err);
  CHECK_MESSAGE(result.err.find("far.cycle:10:3: note: not reached in any case") != std::string::npos,
                result.err);
  const std::size_t first = result.err.find("[verify-not-reached]");
  REQUIRE(first != std::string::npos);
  CHECK_MESSAGE(result.err.find("[verify-not-reached]", first + 1) == std::string::npos, result.err);
}
