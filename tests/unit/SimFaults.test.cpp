// What `sim` finds wrong with a run in which nothing crashes: no green PASS over it.
#include "tests/GoldenRunner.h"
#include "tests/TestFolder.h"

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

using namespace dotek::tests;

namespace {

// A block of 60 x 40 x 20 with its upper face at Z0 of the part, 0.2 mm lower than it is meant to be.
class Bench {
public:
  explicit Bench(const char* name) : folder(name) {
    folder.write("part.toml",
                 "schema = 1\n[place]\nshift = [-310.0, -190.0, -420.0]\n[error]\nshift = [0.0, 0.0, -0.2]\n"
                 "[[shape]]\nkind = \"box\"\nmin = [0.0, 0.0, -20.0]\nmax = [60.0, 40.0, 0.0]\n");
    folder.write(
        "machine.toml",
        "schema = 1\n[setup]\nwork_offset = { G54 = \"part\" }\n[probe]\ntool = 9\nball_diameter = 4\n"
        "length = 131.4\nlength_to = \"tip\"\non = true\novertravel = 4\n");
  }
  CommandResult run(const std::string& flags, const std::string& program = "m.nc") {
    CommandResult out = runDotek(splitArguments("sim " + program +
                                                " --part part.toml --machine machine.toml --quiet "
                                                "--svg run.svg --html run.html " +
                                                flags),
                                 folder.path());
    svg = out.status <= 1 ? readAll(folder / "run.svg") : "";
    html = out.status <= 1 ? readAll(folder / "run.html") : "";
    return out;
  }

  TestFolder folder;
  std::string svg, html;
};

bool holds(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

const std::string kBegin = "O0031\nG17 G21 G40 G49 G80 G90\nT9 M6\nG54 G0 X30. Y20.\n";

} // namespace

TEST_CASE("faults: an offset that moves by the length of the tool fails the run, wherever it is written") {
  Bench bench("dotek-faults-length");
  bench.folder.write("O9401.nc", "O9401\nG53\n#3=#5003\nG90 G31 Z-12. F200\nIF[#5063-#5083 LT -11.9] GOTO 6\n"
                                 "#5=#5223+#5063\nG0 Z#3\nG90 G10 L2 P1 Z#5\nM99\nN6 #3000=6(NO TOUCH)\n");
  bench.folder.write("m.nc", kBegin + "G43 H9 Z8.\nG65 P9401\nG91 G28 Z0\nM30\n");
  const CommandResult wrong = bench.run("--programs .");
  CAPTURE(wrong.err);
  CHECK(wrong.status == 1);
  CHECK(holds(wrong.err, "O9401.nc:8:1: error: G54 Z is set from -420.000 to -288.800"));
  CHECK(holds(wrong.err, "131.400 is the length of the tool"));
  CHECK(holds(wrong.err, "[offset-holds-length]"));
  for (const std::string& picture : {bench.svg, bench.html}) {
    CHECK(holds(picture, "id=\"banner\" class=\"fail\""));
    CHECK(holds(picture, "FAIL: TOOL LENGTH IN AN OFFSET"));
  }
  // The right one moves by what the part is off.
  bench.folder.write("O9401.nc", "O9401\nG53\n#3=#5003\nG90 G31 Z-12. F200\nIF[#5063-#5083 LT -11.9] GOTO 6\n"
                                 "#5=#5223+#5063-#5083\nG0 Z#3\nG90 G10 L2 P1 Z#5\nM99\nN6 #3000=6(NO)\n");
  const CommandResult right = bench.run("--programs .");
  CAPTURE(right.err);
  CHECK(right.status == 0);
  CHECK(holds(bench.svg, ">PASS<"));
  CHECK(holds(bench.svg, "G54 Z set from -420.000 to -420.200"));
  // In the main program, of a system that nobody has set: the part says where its zero is.
  bench.folder.write("m.nc", kBegin + "G43 H9 Z8.\nG31 Z-12. F200\nIF[#5063-#5083 LT -11.9] GOTO 6\n"
                                      "#5263=#5223+#5063\nG91 G28 Z0\nM30\nN6 #3000=6(NO TOUCH)\n");
  CHECK(holds(bench.run("").err, "[offset-holds-length]"));
}

TEST_CASE("faults: a computed move that goes up by the length of the tool") {
  Bench bench("dotek-faults-height");
  const auto macro = [&](const std::string& kept) {
    bench.folder.write("O9402.nc", "O9402\nG53\n" + kept +
                                       "G90 G31 Z-12. F200\nIF[#5063-#5083 LT -11.9] GOTO 6\nG0 Z#3\nM99\n"
                                       "N6 #3000=6(NO TOUCH)\n");
  };
  bench.folder.write("m.nc", kBegin + "G43 H9 Z8.\nG65 P9402\nG91 G28 Z0\nM30\n");
  for (const std::string kept :
       {"#3=#5043\n", "#3=#5043-#[2000+#4111]\n", "#9=#4111\n#3=#5043-#[2000+#9]\n"}) {
    macro(kept);
    const CommandResult wrong = bench.run("--programs .");
    CAPTURE(kept);
    CAPTURE(wrong.err);
    CHECK(wrong.status == 1);
    CHECK(holds(wrong.err, "error: this computed move goes to Z139.400, and that is 131.400"));
    CHECK(holds(wrong.err, "[move-holds-length]"));
    CHECK(holds(bench.svg, "FAIL: TOOL LENGTH IN A MOVE"));
  }
  // Under G20 a word has four places, and the height is met to a micron only.
  bench.folder.write("O9402.nc",
                     "O9402\nG20\nG53\n#3=#5043\nG90 G31 Z-.47 F8.\nIF[#5063-#5083 LT -.469] GOTO 6\n"
                     "G0 Z#3\nG21\nM99\nN6 #3000=6(NO TOUCH)\n");
  CHECK(holds(bench.run("--programs .").err, "[move-holds-length]"));
  for (const std::string kept : {"#3=#5043-#5083\n", "#3=#5003\n", "#3=#5043-#[2200+#4111]\n"}) {
    macro(kept);
    const CommandResult right = bench.run("--programs .");
    CAPTURE(kept);
    CAPTURE(right.err);
    CHECK(right.status == 0);
    CHECK(holds(bench.svg, ">PASS<"));
  }
}

TEST_CASE("faults: an over-travel ends the run, once") {
  Bench bench("dotek-faults-travel");
  bench.folder.write("machine.toml",
                     "schema = 1\n[setup]\nwork_offset = { G54 = \"part\" }\n[travel]\nz = [-600.0, 0.0]\n"
                     "[probe]\ntool = 9\nball_diameter = 4\nlength = 131.4\nlength_to = \"tip\"\non = "
                     "true\novertravel = 4\n");
  bench.folder.write("m.nc", kBegin + "G43 H9 Z8.\nG91 G0 Z2000.\nG90 G0 X10.\n#3000=5(LATER)\nM30\n");
  const CommandResult out = bench.run("");
  CAPTURE(out.err);
  CAPTURE(out.out);
  CHECK(out.status == 1);
  CHECK(holds(out.err, "[outside-travel]"));
  CHECK_FALSE(holds(out.err, "[control-alarm]"));
  CHECK_FALSE(holds(out.err, "LATER"));
  CHECK(holds(bench.svg, ">OVER-TRAVEL<"));
  CHECK_FALSE(holds(bench.svg, "; then"));
}

TEST_CASE("faults: the machine stops where its travel ends, in a skip move and in others") {
  Bench bench("dotek-faults-travel-end");
  bench.folder.write("machine.toml",
                     "schema = 1\n[setup]\nwork_offset = { G54 = \"part\" }\n[travel]\nx = [-600.0, 20.0]\n"
                     "[probe]\ntool = 9\nball_diameter = 4\nlength = 131.4\nlength_to = \"tip\"\non = "
                     "true\novertravel = 4\n");
  const auto ends = [&](const std::string& move) {
    bench.folder.write("m.nc", kBegin + "G43 H9 Z100.\n" + move + "\n#100=1.\nM30\n");
    const CommandResult out = bench.run("--json");
    CAPTURE(out.err);
    const nlohmann::json summary = nlohmann::json::parse(out.out);
    CHECK_FALSE(holds(out.err, "miss"));
    CHECK(holds(bench.svg, "0 misses"));
    CHECK_FALSE(holds(out.out, "\"outcome\": \"miss\""));
    CHECK(holds(bench.svg, ">OVER-TRAVEL<"));
    CHECK_FALSE(holds(bench.svg, ">E2<")); // the alarm is the over-travel
    return summary["machine"]["X"].get<double>();
  };
  CHECK(ends("G91 G31 X900. F300") == 20);
  CHECK(ends("G0 X950.") == 20);
  CHECK(ends("G91 G1 X900. F500") == 20);
  CHECK(ends("G53 G0 X33.") == 20);
}

TEST_CASE("faults: a tool that is in no list is not drawn as the probe") {
  Bench bench("dotek-faults-tool-unknown");
  bench.folder.write("machine.toml",
                     "schema = 1\n[setup]\nwork_offset = { G54 = \"part\" }\n[probe]\ntool = 9\n"
                     "ball_diameter = 4\nlength = 131.4\nlength_to = \"tip\"\non = true\novertravel = 4\n");
  bench.folder.write("m.nc", "O1\nT9 M6\nG90 G21 G54 G0 X5. Y5.\nG43 H9 Z20.\nG91 G28 Z0\nG90\nT3 M6\n"
                             "G0 X5. Y5.\nG43 H3 Z7.\nM30\n");
  bench.run("--var 2203=80 --control fanuc-31i-b");
  CHECK(holds(bench.svg, "with tool 3 it is that of the end by the length in force"));
  CHECK(holds(bench.svg, "80.000: no list has the tool"));
  CHECK(holds(bench.html, "with tool 3 it is that of the end by the length in force, 80.000"));
}

TEST_CASE("faults: a macro that is called leaves its rotation to the caller") {
  Bench bench("dotek-faults-shift");
  bench.folder.write("m.nc", "O9403\nG68 X0 Y0 R12.\nM99\n");
  CHECK_FALSE(holds(bench.run("--call \" \"").err, "[shift-left-on]"));
  bench.folder.write("m.nc", "O0403\nG68 X0 Y0 R12.\nM30\n");
  CHECK(holds(bench.run("").err, "[shift-left-on]"));
}

TEST_CASE("faults: a spindle that turns while the probe measures") {
  Bench bench("dotek-faults-spindle");
  const std::string touch = "G43 H9 Z8.\nG31 Z-12. F200\nIF[#5063-#5083 LT -11.9] GOTO 6\nG0 Z8.\nG91 G28 "
                            "Z0\nM30\nN6 #3000=6(NO)\n";
  for (const char* on : {"M3 S500\n", "S250 M4\n"}) {
    bench.folder.write("m.nc", kBegin + on + touch);
    const CommandResult out = bench.run("");
    CAPTURE(out.err);
    CHECK(out.status == 1);
    CHECK(holds(out.err, "m.nc:7:1: error: the spindle turns (M"));
    CHECK(holds(out.err, "[spindle-turns-probe]"));
    CHECK(holds(bench.html, "FAIL: SPINDLE ON"));
  }
  // Stopped by M5 or M19; turned only to switch the probe on.
  for (const char* on : {"M3 S500\nM5\n", "M3 S500\nM19\n", ""}) {
    bench.folder.write("m.nc", kBegin + on + touch);
    const CommandResult out = bench.run("");
    CAPTURE(out.err);
    CHECK(out.status == 0);
    CHECK(holds(bench.svg, ">PASS<"));
  }
  // A change of tools stops it.
  bench.folder.write("m.nc", "O0032\nM3 S900\n" + kBegin.substr(6) + touch);
  CHECK(bench.run("").status == 0);
}

TEST_CASE("faults: a macro that leaves G49 on, and a caller that goes on with Z") {
  Bench bench("dotek-faults-g49");
  const std::string macro = "O9402\nG49\nG91 G28 Z0\nG90\nM99\n";
  bench.folder.write("m.nc", kBegin + "G43 H9 Z150.\nG65 P9402\nG0 X70. Y20. Z160.\nM30\n" + macro);
  const CommandResult out = bench.run("");
  CAPTURE(out.err);
  CHECK(out.status == 1);
  CHECK(holds(out.err, "m.nc:7:1: error: O9402 has taken the tool length 131.400 off"));
  CHECK(holds(out.err, "[length-taken-off]"));
  CHECK(holds(out.err, "at Z160.000 of the spindle the tool's end is at Z28.600"));
  CHECK(holds(bench.svg, "FAIL: TOOL LENGTH OFF"));
  bench.folder.write("m.nc",
                     kBegin + "G43 H9 Z150.\nG65 P9402\nG43 H9 Z60.\nG0 X70. Y20. Z50.\nM30\n" + macro);
  CHECK(bench.run("").status == 0);
  bench.folder.write("m.nc", kBegin + "G43 H9 Z150.\nG65 P9402\nG91 G28 Z0\nM30\n" + macro);
  CHECK(bench.run("").status == 0);
}

TEST_CASE("faults: a variable that nobody has set counts as 0, and the run says so") {
  Bench bench("dotek-faults-unset");
  const std::string touch = "G53\n#3=#5003\nG31 X#24 F200\nIF[#5061 GT [#24-.01]] GOTO 6\n";
  bench.folder.write("m.nc", "O9403\n" + touch + "#110=#5061+#640\nG0 X-20.\nM99\nN6 #3000=6(NO)\n");
  const std::string call = "--at -20,20,-5 --call \"X20.\" ";
  const CommandResult out = bench.run(call);
  CAPTURE(out.err);
  CHECK(out.status == 0);
  CHECK(holds(out.err, "m.nc:6:1: warning: #640 is read here and has no value"));
  CHECK(holds(out.err, "`--var 640=VALUE`"));
  CHECK_FALSE(holds(bench.svg, ">PASS<"));
  CHECK(holds(bench.svg, "PASS, WITH VALUES MISSING"));
  const CommandResult given = bench.run(call + "--var 640=1.98");
  CHECK_FALSE(holds(given.err, "[variable-not-set]"));
  CHECK(holds(bench.svg, ">PASS<"));
  // Asked about, counted up from nothing, or by a computed number.
  bench.folder.write("m.nc", "O9403\n" + touch +
                                 "IF[#641 EQ #0] GOTO 7\nN7\n#642=#642+1\n#110=#5061\nG0 X-20.\nM99\n"
                                 "N6 #3000=6(NO)\n");
  CHECK_FALSE(holds(bench.run(call).err, "[variable-not-set]"));
  bench.folder.write("m.nc",
                     "O9403\n" + touch + "#110=#5061+#[640+#2]+#648\nG0 X-20.\nM99\nN6 #3000=6(NO)\n");
  CHECK(holds(bench.run(call).err, "#648 is read here"));
}

TEST_CASE("faults: a macro that is called has the probe of the machine's file as its tool") {
  Bench bench("dotek-faults-tool");
  bench.folder.write("m.nc", "O9404\nG53\n#3=#5003\nG31 Z#26 F200\nIF[#5063-#5083 LT [#26+.01]] GOTO 6\n"
                             "#111=#5063-#5083\nG0 Z#3\nM99\nN6 #3000=6(NO)\n");
  const CommandResult out = bench.run("--at 30,20,8 --call \"Z-9.\" --json");
  CAPTURE(out.err);
  CHECK(out.status == 0);
  CHECK(holds(out.out, "\"111\": -0.2"));
  // And its length is the one of its offset.
  bench.folder.write("m.nc", kBegin + "G43 H9 Z8.\nG53\n#112=#5083\nM30\n");
  const CommandResult length = bench.run("--json");
  CHECK(holds(length.out, "\"112\": 131.4"));
  CHECK_FALSE(holds(length.err, "[tool-length-not-set]"));
}

TEST_CASE("faults: the code that takes a position away is named") {
  Bench bench("dotek-faults-lost");
  bench.folder.write("m.nc",
                     kBegin + "G43 H9 Z8.\nG91 G28 Z0\nG90\nG0 X-30. Y20.\nG0 Z-5.\nG31 X10. F100\nM30\n");
  const CommandResult out = bench.run("");
  CAPTURE(out.err);
  CHECK(out.status == 1);
  CHECK(holds(out.err, "since `G28` in line 6"));
  CHECK(holds(out.err, "write G43 H and Z again after it"));
  CHECK_FALSE(holds(out.err, "G30"));
}

TEST_CASE("faults: a fast skip move that ends before the face is the approach of the next one") {
  Bench bench("dotek-faults-approach");
  const std::string begin = "O9405\nG53\n#3=#5001\nG90\n";
  const std::string rest = "IF[#5061 GT [#24-.01]] GOTO 6\n#110=#5061\nG0 X#3\nM99\nN6 #3000=6(NO)\n";
  const std::string call = "--at -20,20,-5 --call \"X4.\" ";
  bench.folder.write("m.nc", begin + "G31 X-6. F1500\nG31 X#24 F90\n" + rest);
  const CommandResult right = bench.run(call);
  CAPTURE(right.err);
  CHECK(right.status == 0);
  CHECK_FALSE(holds(right.err, "[probe-miss]"));
  CHECK(holds(bench.svg, ">PASS<"));
  CHECK(holds(bench.svg, "0 misses"));
  // Another way, or a second miss: as before.
  bench.folder.write("m.nc", begin + "G31 Y22. F1500\nG31 X#24 F90\n" + rest);
  CHECK(holds(bench.run(call).err, "[probe-miss]"));
  bench.folder.write("m.nc", begin + "G31 X-9. F1500\nG31 X-6. F90\n" + rest);
  CHECK(holds(bench.run(call).err, "[probe-miss]"));
  CHECK(holds(bench.svg, "2 misses"));
}

TEST_CASE("faults: M99 at the end of a main program ends a run in which nothing changes any more") {
  const TestFolder folder("dotek-faults-anew");
  const auto sim = [&](const std::string& flags) {
    return runDotek(splitArguments("sim m.nc " + flags), folder.path());
  };
  folder.write("m.nc", "O9171\nPOPEN\nDPRNT[BORE*#620[34]]\nPCLOS\nM99\n");
  const CommandResult printed = sim("--var 620=12.5 --json");
  CAPTURE(printed.err);
  CHECK(printed.status == 1);
  CHECK(printed.out.size() < 10'000);
  CHECK(holds(printed.err, "begins it anew, and the last pass has changed nothing"));
  CHECK(holds(printed.err, "`--call \" \"` calls it once"));
  // One that counts, and never ends.
  folder.write("m.nc", "O9172\n#621=#621+1\nM99\n");
  CHECK(holds(sim("--quiet").err, "1000 times by now"));
  // One that counts and ends runs to its end.
  folder.write("m.nc", "O9173\n#621=#621+1\nIF[#621 LT 2500] GOTO 5\nM30\nN5 M99\n");
  CHECK(sim("--quiet").status == 0);
}

TEST_CASE("faults: the probe under cutter compensation is not where the program says") {
  Bench bench("dotek-comp");
  const auto sim = [&](const std::string& program) {
    bench.folder.write("m.nc", "O7\nG90 G54 G0 G43 H9 Z50.\n" + program + "M30\n");
    return runDotek(
        splitArguments("sim m.nc --part part.toml --machine machine.toml --tool 9 --at 0,0,50 --quiet"),
        bench.folder.path());
  };
  for (const char* code : {"G41 D5", "G42 D5", "G17 G1 G41"}) {
    CAPTURE(code);
    const CommandResult result = sim(fmt::format("{} X10. F500\nY20.\nG40 X0\n", code));
    CAPTURE(result.err);
    CHECK(result.status == 1);
    CHECK(holds(result.err, "m.nc:3:1: error"));
    CHECK(holds(result.err, "under cutter compensation"));
  }
  CHECK(sim("G40 G1 X10. F500\nY20.\n").status == 0);
  CHECK(sim("G41 D5\nG40\nG1 X10. F500\n").status == 0); // nothing moves under it
  // A tool that cuts goes on.
  CHECK_FALSE(holds(sim("T2 M6\nG41 D5 G1 X10. F500\nG40 X0\n").err, "under cutter compensation"));
}

TEST_CASE("faults: the probe under cutter compensation meets what lies on its offset path") {
  Bench bench("dotek-comp-path");
  // Along the box, whose side is at X0: the ball of 4 passes at X-6 and does not at or X4.
  const auto sim = [&](const std::string& code, const std::string& radius) {
    bench.folder.write("m.nc", "O7\nG90 G54 G0 G43 H9 Z50.\nX-1. Y-30.\nG1 Z-5. F500\n" + code +
                                   " D5 Y-20.\nY60.\nG40 X-30.\nG0 Z50.\nM30\n");
    return runDotek(splitArguments("sim m.nc --part part.toml --machine machine.toml --tool 9 --at 0,0,50 "
                                   "--quiet --var 13005=" +
                                   radius),
                    bench.folder.path());
  };
  const CommandResult beside = sim("G41", "5");
  CAPTURE(beside.err);
  CHECK(beside.status == 0);
  for (const CommandResult& into : {sim("G42", "5"), sim("G41", "0.5"), sim("G41", "-5")}) {
    CAPTURE(into.err);
    CHECK(into.status == 1);
    CHECK_FALSE(holds(into.err, "under cutter compensation"));
  }
}

TEST_CASE("faults: a chamfer or a rounding at a corner is not followed, and is no stray comma") {
  Bench bench("dotek-corner");
  for (const char* block : {"G1 X10. F100 ,C2.", "G1 X10. F100 , R.5", "G1 X#1 F100 ,C2."}) {
    CAPTURE(block);
    bench.folder.write("m.nc", fmt::format("O7\nG90 G54 G0 Z50.\n{}\nM30\n", block));
    const CommandResult result = runDotek(splitArguments("sim m.nc --quiet"), bench.folder.path());
    CAPTURE(result.err);
    CHECK(result.status == 1);
    CHECK(holds(result.err, "m.nc:3:"));
    CHECK(holds(result.err, "is a chamfer"));
    CHECK_FALSE(holds(result.err, "remove it"));
  }
  bench.folder.write("m.nc", "O7\nG1 X10. F100 , Y5.\nM30\n");
  CHECK(holds(runDotek(splitArguments("sim m.nc --quiet"), bench.folder.path()).err, "remove it"));
}
