// Where a run begins, and what its zeros are.
#include "tests/GoldenRunner.h"
#include "tests/TestFolder.h"

#include <doctest/doctest.h>
#include <string>
#include <string_view>

using namespace dotek::tests;

namespace {

constexpr std::string_view kBox =
    "schema = 1\n[place]\nshift = [-300.0, -200.0, -400.0]\n[[shape]]\nkind = \"box\"\n"
    "min = [0.0, 0.0, -20.0]\nmax = [50.0, 50.0, 0.0]\n";
constexpr std::string_view kProbe =
    "[probe]\nball_diameter = 6\nlength = 120\nlength_to = \"tip\"\non = true\n";

bool has(const CommandResult& result, std::string_view part) {
  CAPTURE(result.err);
  CAPTURE(result.out);
  return (result.out + result.err).find(part) != std::string::npos;
}

} // namespace

TEST_CASE("start: --at is where the end of the stylus is, with a number of the probe and without") {
  const TestFolder scratch("dotek-start-at");
  scratch.write("part.toml", kBox);
  scratch.write("bare.toml", "schema = 1\n" + std::string(kProbe));
  scratch.write("named.toml", "schema = 1\n" + std::string(kProbe) + "tool = 9\n");
  scratch.write("o.nc", "%\nO0042\nG21 G90\nG54 G0 X10. Y10.\n#100=#5023\nM30\n%\n");
  const auto run = [&](const std::string& flags) {
    return runDotek(
        splitArguments("sim o.nc --part part.toml --work-offset G54=part --at -20,-20,60 --json " + flags),
        scratch.path());
  };
  // 60 above the part, which is at -400: nothing is met.
  for (const std::string flags :
       {"--machine bare.toml", "--machine named.toml", "--machine named.toml --tool 9"}) {
    const CommandResult out = run(flags);
    CHECK(out.status == 0);
    CHECK(has(out, "\"100\": -220"));
  }
}

TEST_CASE("start: the travel counts the length of a probe without a number") {
  const TestFolder scratch("dotek-start-travel");
  scratch.write("part.toml", kBox);
  scratch.write("machine.toml", "schema = 1\n[travel]\nz = [-500.0, 0.0]\n" + std::string(kProbe));
  scratch.write("o.nc", "%\nO0042\nG21 G90\nG54 G0 X10. Y10.\nM30\n%\n");
  const std::string command =
      "sim o.nc --part part.toml --machine machine.toml --work-offset G54=part --at 0,0,";
  CHECK(runDotek(splitArguments(command + "280"), scratch.path()).status == 0);
  CHECK(has(runDotek(splitArguments(command + "281"), scratch.path()), "the travel ends at Z0.000"));
}

TEST_CASE("start: a work offset of [setup] that counts with a part alone is named in each run without one") {
  const TestFolder scratch("dotek-start-zero");
  scratch.write("part.toml", kBox);
  scratch.write("machine.toml",
                "schema = 1\n" + std::string(kProbe) +
                    "tool = 9\n[setup]\nwork_offset = { G54 = \"part\", G55 = \"part\", G56 = "
                    "[-10.0, -10.0, -10.0] }\n");
  scratch.write("o.nc", "%\nO0042\nG21 G90\n#100=#5023\nM30\n%\n");
  scratch.write("plain.nc", "%\nO0043\nG21 G90\nM30\n%\n");
  const auto run = [&](const std::string& flags) {
    return runDotek(splitArguments("sim " + flags + " --machine machine.toml"), scratch.path());
  };
  for (const std::string program : {"o.nc", "plain.nc"}) {
    const CommandResult out = run(program);
    CHECK(out.status == 0);
    CHECK(has(out, "note: `machine.toml` puts G54, G55 where the part is, and no part is given"));
    CHECK(has(out, "[zero-left-out]"));
  }
  CHECK(!has(run("o.nc --part part.toml"), "zero-left-out"));
  CHECK(has(run("o.nc --work-offset G55=1,2,3"), "puts G54 where the part is"));
  CHECK(!has(run("o.nc --work-offset G54=1,2,3 --work-offset G55=1,2,3"), "zero-left-out"));
}
