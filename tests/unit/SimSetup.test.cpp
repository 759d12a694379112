// --call, --tool, --work-offset, --at and [setup]; the commands of the page that shows them, as they are
// printed.
#include "tests/GoldenRunner.h"
#include "tests/TestFolder.h"
#include "tests/policy/Tree.h"
#include "tests/unit/PageCommands.h"

#include <doctest/doctest.h>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace fs = std::filesystem;
using namespace dotek::tests;

namespace {

CommandResult runIn(const TestFolder& folder, const std::string& command) {
  return runDotek(splitArguments(command), folder.path());
}

constexpr std::string_view kBox =
    "schema = 1\n[place]\nshift = [-300.0, -200.0, -400.0]\n[[shape]]\nkind = \"box\"\n"
    "min = [0.0, 0.0, -20.0]\nmax = [50.0, 50.0, 0.0]\n";
constexpr std::string_view kDown =
    "O9001\nIF[#26 EQ #0]THEN #3000=1(Z MISSING)\nG31 Z#26 F100\n#100=#5063-#5083\nG53\n"
    "#101=#5021\nM99\n";

bool has(const CommandResult& result, std::string_view part) {
  CAPTURE(result.err);
  CAPTURE(result.out);
  return (result.out + result.err).find(part) != std::string::npos;
}

} // namespace

TEST_CASE("setup: each command of the page run-my-macro does what the page says") {
  const TestFolder scratch("dotek-run-my-macro");
  fs::copy(root() / "examples", scratch / "examples", fs::copy_options::recursive);
  const auto commands = commandsOf(readAll(root() / "docs" / "run-my-macro.md"));
  REQUIRE(commands.size() >= 6);
  for (const auto& [heading, command] : commands) {
    CAPTURE(command);
    const CommandResult result = runIn(scratch, command);
    CAPTURE(result.err);
    const bool fails = heading.find("Let it fail") != std::string::npos ||
                       command.find("--length 87.4") != std::string::npos;
    CHECK(result.status == (fails ? 1 : 0));
    CHECK(result.err.find("warning:") == std::string::npos);
  }
  CHECK(fs::file_size(scratch / "bore.html") > 1000);
  CHECK(fs::file_size(scratch / "bore.svg") > 1000);
}

TEST_CASE("setup: the macros of examples lint clean") {
  const CommandResult result = runDotek({"lint", "examples/macros"}, root());
  CHECK(result.status == 0);
  CHECK(result.out == "");
}

TEST_CASE("setup: a called macro measures what the part is, from where --at puts the stylus") {
  const TestFolder scratch("dotek-setup-call");
  scratch.write("part.toml", kBox);
  scratch.write("down.nc", kDown);
  const std::string stylus = "sim down.nc --part part.toml --tool 7 --length 80 --diameter 6 --json ";
  const CommandResult part = runIn(scratch, stylus + "--work-offset G54=part --at 10,20,5 --call \"Z-3.\"");
  CHECK(part.status == 0);
  CHECK(has(part, "\"100\": 0,"));
  CHECK(has(part, "\"101\": -290"));
  // A zero 2 mm above the part; the letters as a program has them, too.
  const CommandResult above =
      runIn(scratch, stylus + "--work-offset G54=-300,-200,-398 --at 10,20,5 --call \"G65 P9001 Z-3.\"");
  CHECK(above.status == 0);
  CHECK(has(above, "\"100\": -2,"));
  const CommandResult missing = runIn(scratch, stylus + "--work-offset G54=part --at 10,20,5 --call \" \"");
  CHECK(missing.status == 1);
  CHECK(has(runIn(scratch, stylus + "--work-offset G54=part --at 10,20,5 --call \"X1.\""), "Z MISSING"));
}

TEST_CASE("setup: [setup] of the machine's file says the same as the flags, and flags go first") {
  const TestFolder scratch("dotek-setup-file");
  scratch.write("part.toml", kBox);
  scratch.write("down.nc", kDown);
  scratch.write("machine.toml",
                "schema = 1\n[setup]\ntool = 2\nwork_offset = { G54 = \"part\" }\nat = [10, 20, 5]\n"
                "call = \"Z-3.\"\n[probe]\nball_diameter = 6\nlength = 80\nlength_to = \"tip\"\non = true\n");
  const std::string run = "sim down.nc --part part.toml --machine machine.toml --json ";
  CHECK(has(runIn(scratch, run), "\"100\": 0,"));
  CHECK(has(runIn(scratch, run + "--at 12,20,5"), "\"101\": -288"));
  // A length in the table that is not the probe's measures wrong, as on the machine.
  CHECK(has(runIn(scratch, run + "--tool 2 --length 81"), "\"100\": -1,"));
  scratch.write("machine.toml",
                "schema = 1\n[setup]\nwork_offset = { G60 = [0, 0, 0], G54 = [1, 2] }\nlength = 5\n"
                "[probe]\nball_diameter = 6\nlength = 80\nlength_to = \"tip\"\non = true\n");
  const CommandResult wrong = runIn(scratch, run);
  CHECK(wrong.status != 0);
  CHECK(has(wrong, "`G60` is no work system"));
  CHECK(has(wrong, "[X, Y, Z]"));
  CHECK(has(wrong, "`length` is that of `tool`"));
}

TEST_CASE("setup: [setup] of a job file goes before that of the machine and after the flags") {
  const TestFolder scratch("dotek-setup-job");
  scratch.write("part.toml", kBox);
  scratch.write("down.nc", kDown);
  scratch.write("machine.toml",
                "schema = 1\n[setup]\ntool = 2\nwork_offset = { G54 = \"part\" }\nat = [10, 20, 5]\n"
                "call = \"Z-1.\"\n[probe]\nball_diameter = 6\nlength = 80\nlength_to = \"tip\"\non = true\n");
  const std::string job = "schema = 1\noperation = [ { cycle = \"bore\" } ]\n";
  scratch.write("job.toml", job + "[setup]\nat = [12, 20, 5]\ncall = \"Z-3.\"\n"
                                  "tools = [{ number = 5, length = 82.4 }]\n");
  const std::string run = "sim down.nc --part part.toml --machine machine.toml --job job.toml --json ";
  const CommandResult both = runIn(scratch, run);
  CHECK(both.status == 0);
  CHECK(has(both, "\"100\": 0,"));
  CHECK(has(both, "\"101\": -288"));
  CHECK(has(runIn(scratch, run + "--at 14,20,5"), "\"101\": -286"));
  scratch.write("job.toml", job + "[setup]\ntol = 2\n");
  CHECK(has(runIn(scratch, run), "unknown key `tol`"));
  scratch.write("job.toml", job);
  CHECK(has(runIn(scratch, run), "\"101\": -290"));
  CHECK(runIn(scratch, "sim down.nc --job none.toml").status == 2);
  scratch.write("p.SUF", "N10 G0 X1 Y1\nN20 M30\n");
  CHECK(has(runIn(scratch, "sim p.SUF --job job.toml"), "rapid X1.000000 Y1.000000"));
}

TEST_CASE("setup: what [setup] says of the offset of the tool in the spindle holds, and is said once") {
  const TestFolder scratch("dotek-setup-offsets");
  scratch.write("length.nc", "%\nO71\nG90 G54 G43 H6 Z20.\n#100=#5083\nM30\n%\n");
  const std::string head = "schema = 1\n[setup]\nwork_offset = { G54 = [-300, -200, -400] }\n";
  const std::string rest =
      "[probe]\ntool = 24\nball_diameter = 6\nlength = 165\nlength_to = \"tip\"\non = true\n"
      "[[tool]]\nnumber = 6\nlength = 110\ndiameter = 12\n";
  const std::string run = "sim length.nc --machine m.toml --json ";
  scratch.write("m.toml", head + "tools = [{ number = 6, length = 95 }]\n" + rest);
  CHECK(has(runIn(scratch, run + "--tool 6"), "\"100\": 95}"));
  CHECK(has(runIn(scratch, run), "\"100\": 95}"));
  CHECK(has(runIn(scratch, run + "--tool 6 --length 97"), "\"100\": 97}"));
  scratch.write("m.toml", head + "tool = 6\n" + rest);
  CHECK(has(runIn(scratch, run), "\"100\": 110}"));
  CHECK(has(runIn(scratch, run + "--length 96"), "\"100\": 96}")); // of the tool that the file names
  scratch.write("m.toml", head + "tool = 24\nlength = 160\n" + rest);
  CHECK(has(runIn(scratch, run + "--tool 6"), "\"100\": 110}")); // 160 was that of the probe
  scratch.write("m.toml", head + "tool = 6\nlength = 96\ntools = [{ number = 6, length = 95 }]\n" + rest);
  const CommandResult twice = runIn(scratch, run);
  CHECK(twice.status == 1);
  CHECK(has(twice, "the length of tool 6 is said twice"));
  scratch.write("m.toml", head + rest);
  const CommandResult nobody = runIn(scratch, run + "--length 96");
  CHECK(nobody.status == 1);
  CHECK(has(nobody, "`--tool N` says of which"));
}

TEST_CASE("setup: [setup] of a job file is checked by every command that reads the job") {
  const TestFolder scratch("dotek-setup-read");
  scratch.write("down.nc", kDown);
  const std::string job = "schema = 1\noperation = [ { cycle = \"surface-x\" } ]\n[setup]\n";
  const std::string cycle = (root() / "examples/surface-x").string();
  const std::string post = " --job job.toml --prog " + (root() / "examples/post.txt").string();
  for (const auto& [table, told] :
       {std::pair("lenght = 5\n", "unknown key `lenght`"), std::pair("tool = 0\n", "0"),
        std::pair("work_offset = { G53 = [0, 0, 0] }\n", "`G53` is no work system")}) {
    scratch.write("job.toml", job + table);
    for (const std::string& command :
         {"post " + cycle + post, "convert " + cycle + " --to fanuc" + post, "verify " + cycle + post,
          std::string("lint job.toml"), std::string("sim down.nc --job job.toml")}) {
      CAPTURE(command);
      const CommandResult result = runIn(scratch, command);
      CHECK(result.status != 0);
      CHECK(has(result, told));
    }
  }
  // A job may say nothing but the setup.
  scratch.write("job.toml", "schema = 1\nhost = { clearance = 5.0 }\n[setup]\ntool = 3\nlength = 120.0\n");
  scratch.write("at.nc", "O1\nG43 H3 Z10.\nG53\n#101=#5023\nM30\n");
  CHECK(has(runIn(scratch, "sim at.nc --job job.toml --json"), "\"101\": 130"));
  const CommandResult posted = runIn(scratch, "post " + cycle + post + " --set G=54");
  CHECK(posted.status == 0);
  CHECK(has(posted, "G65 P9023 S54"));
}

TEST_CASE("setup: a start beyond the machine's travel is an error with axis, place and limit") {
  const TestFolder scratch("dotek-setup-travel");
  scratch.write("down.nc", kDown);
  const std::string probe = "[probe]\nball_diameter = 6\nlength = 80\nlength_to = \"tip\"\non = true\n";
  const std::string travel = "schema = 1\n[travel]\nx = [-400, 0]\nz = [-500, 0]\n";
  const std::string setup = "[setup]\ntool = 2\nwork_offset = { G54 = [-300, -200, -400] }\n";
  scratch.write("machine.toml", travel + setup + probe);
  const std::string run = "sim down.nc --machine machine.toml --json ";
  // Z of the spindle: -400 + 80 of the tool + what --at says. The end of the travel itself is allowed.
  CHECK_FALSE(has(runIn(scratch, run + "--at 10,20,320"), "travel"));
  const CommandResult above = runIn(scratch, run + "--at 10,20,320.5");
  CHECK(above.status == 1);
  CHECK(has(above, "`--at`: it puts the spindle to machine Z0.500, and the travel ends at Z0.000"));
  CHECK_FALSE(has(above, "--work-offset"));
  CHECK(has(runIn(scratch, run + "--at -100.25,20,5"),
            "it puts the spindle to machine X-400.250, and the travel ends at X-400.000"));
  // An axis without travel is not judged.
  CHECK_FALSE(has(runIn(scratch, run + "--at 10,2000,5"), "travel"));
  // As said by the machine's file and by the job's.
  scratch.write("machine.toml", travel + setup + "at = [10, 20, 330]\n" + probe);
  CHECK(has(runIn(scratch, run), "`at` of `[setup]`: it puts the spindle to machine Z10.000"));
  CHECK_FALSE(has(runIn(scratch, run + "--at 10,20,5"), "travel"));
  scratch.write("job.toml", "schema = 1\nhost = { clearance = 5.0 }\n[setup]\nat = [301, 20, 5]\n");
  CHECK(has(runIn(scratch, run + "--job job.toml"),
            "`at` of `[setup]`: it puts the spindle to machine X1.000"));
  // A variable of a flag may move the system.
  CHECK(has(runIn(scratch, run + "--at 10,20,5 --var 5223=0"), "machine Z85.000"));
  scratch.write("machine.toml", travel + "[start]\nz = 20\n" + probe);
  const CommandResult start = runIn(scratch, run);
  CHECK(start.status != 0);
  CHECK(has(start, "Z20.000 is beyond the travel, which ends at Z0.000"));
  // A cycle as well.
  scratch.write("down.cycle",
                "cycle down \"Down\"\n\nspindle off\nprobe on\ntouch z by -9 mm -> face\nprobe off\n");
  scratch.write("machine.toml", travel + setup + probe);
  const CommandResult cycle = runIn(scratch, "sim down.cycle --machine machine.toml --at 10,20,400");
  CHECK(cycle.status == 1);
  CHECK(has(cycle, "machine Z80.000"));
}

TEST_CASE("setup: a start beyond the travel over a zero that nothing has set names --work-offset") {
  const TestFolder scratch("dotek-setup-zero");
  scratch.write("down.nc", kDown);
  scratch.write("part.toml", kBox);
  scratch.write("machine.toml", "schema = 1\n[travel]\nz = [-500, 0]\n[probe]\nball_diameter = 6\n"
                                "length = 80\nlength_to = \"tip\"\non = true\n");
  const std::string run =
      "sim down.nc --machine machine.toml --part part.toml --call \"Z-3.\" --tool 1 --at 10,20,5";
  CHECK(has(runIn(scratch, run), "`--work-offset G54=part` puts it where the part is"));
  CHECK_FALSE(has(runIn(scratch, run + " --work-offset G54=part"), "travel"));
}

TEST_CASE("setup: an alarm over the tool length names --tool where the machine's file has a probe") {
  const TestFolder scratch("dotek-setup-length");
  scratch.write("ask.nc",
                "O9002\nIF[#4008 NE 49]GOTO 10\n#3000=17(TOOL LENGTH NOT ACTIVE)\nN10 G0 Z5.\nM99\n");
  scratch.write("other.nc", "O9003\n#3000=18(Z MISSING)\nM99\n");
  scratch.write("machine.toml", "schema = 1\n[probe]\nball_diameter = 6\nlength = 80\nlength_to = \"tip\"\n"
                                "on = true\n");
  const std::string machine = " --machine machine.toml --call \" \"";
  CHECK(has(runIn(scratch, "sim ask.nc" + machine), "`--tool N`"));
  CHECK_FALSE(has(runIn(scratch, "sim other.nc" + machine), "`--tool N`"));
  CHECK_FALSE(has(runIn(scratch, "sim ask.nc --call \" \""), "`--tool N` puts"));
  CHECK_FALSE(has(runIn(scratch, "sim ask.nc" + machine + " --tool 3"), "TOOL LENGTH"));
}

TEST_CASE("setup: a picture that was not written names the file of an earlier run only where there is one") {
  const TestFolder scratch("dotek-picture-earlier");
  scratch.write("broken.nc", "O1\n#1=[2\nM30\n");
  const CommandResult none = runIn(scratch, "sim broken.nc --svg run.svg --html run.html");
  CHECK(has(none, "no picture was written"));
  CHECK_FALSE(has(none, "earlier run"));
  scratch.write("run.html", "old");
  const CommandResult one = runIn(scratch, "sim broken.nc --svg run.svg --html run.html");
  CHECK(has(one, "`run.html` is from an earlier run"));
  CHECK_FALSE(has(one, "`run.svg` is"));
}

TEST_CASE("list: the calls of a set of macros say what their letters mean and which exclude each other") {
  const CommandResult set = runDotek({"list", "macros", "inspection-plus"}, root());
  CHECK(set.status == 0);
  const std::size_t pocket = set.out.find("\nP9812 pocket along X");
  REQUIRE(pocket != std::string::npos);
  const std::string call = set.out.substr(pocket, set.out.find("\n\n", pocket + 1) - pocket);
  CAPTURE(call);
  CHECK(call.find("  X  expected width; always given") != std::string::npos);
  CHECK(call.find("  U  upper limit of the error") != std::string::npos);
  CHECK(call.find("  H  tolerance of the size") != std::string::npos);
  CHECK(call.find("  S  work offset to set: 1 to 6 are G54 to G59") != std::string::npos);
  CHECK(call.find("not together: S, H") != std::string::npos);
  const CommandResult none = runDotek({"list", "macros", "none"}, root());
  CHECK(none.status == 2);
  CHECK(none.err.find("inspection-plus") != std::string::npos);
  CHECK(runDotek({"list", "rules", "none"}, root()).status == 2);
}

TEST_CASE("setup: a program that is not there names the folders that were searched") {
  const TestFolder scratch("dotek-setup-missing");
  scratch.write("main.nc", "O1\nM98 P777\nM30\n");
  scratch.write("macros/O9000.nc", "O9000\nM99\n");
  CHECK(has(runIn(scratch, "sim main.nc"), "programs of other files are found with `--programs DIR`"));
  const CommandResult searched = runIn(scratch, "sim main.nc --programs macros");
  CHECK(has(searched, "neither this file nor `macros` (`--programs`) has a program of this number"));
  CHECK_FALSE(has(searched, "are found with"));
}

TEST_CASE("setup: a computed call of a program that has errors says so, and is no alarm of the control") {
  const TestFolder scratch("dotek-setup-broken");
  scratch.write("main.nc", "O1\n#1=9001\nG65 P#1\nM30\n");
  scratch.write("macros/O9001.nc", "O9001\n#1=[2+\nM99\n");
  scratch.write("macros/O9812", "O9812\n#1=[2+\nM99\n");
  const CommandResult broken = runIn(scratch, "sim main.nc --programs macros --json");
  CHECK(broken.status == 1);
  CHECK(has(broken, "\"ending\": \"inconclusive\""));
  CHECK(has(broken, "O9001, which is in `macros/O9001.nc` and has errors"));
  CHECK_FALSE(has(broken, "alarm 78"));
  // Nor does a vendor's macro of that number run instead.
  scratch.write("main.nc", "O1\n#1=9812\nG65 P#1 X10.\nM30\n");
  CHECK(has(runIn(scratch, "sim main.nc --programs macros"),
            "O9812, which is in `macros/O9812` and has errors"));
  // One that nothing calls in the end does not matter, and one that is nowhere is the alarm.
  scratch.write("main.nc", "O1\n#1=9002\nG65 P#1\nM30\n");
  CHECK(has(runIn(scratch, "sim main.nc --programs macros"), "alarm 78"));
}

TEST_CASE("sim: an error in a program of the file that nothing calls stops no run") {
  const TestFolder scratch("dotek-uncalled");
  const auto run = [&](const std::string& text, const std::string& flags = "") {
    scratch.write("main.nc", text);
    return runIn(scratch, "sim main.nc" + flags);
  };
  const CommandResult uncalled =
      run("%\nO1\n#1=2.\nG0 X#1\nM98 P3\nM30\nO2\n#1=[2.+\nM99\nO3\nG0 Y5.\nM99\n%\n");
  CHECK(uncalled.status == 0);
  CHECK(has(uncalled, "rapid X2.000000 Y5.000000"));
  CHECK(has(uncalled, "main.nc:7:1: warning: this program has errors"));
  CHECK(has(uncalled, "[program-uncalled]"));
  CHECK(has(uncalled, "main.nc:8:4: note: the block has 1 `[`"));
  // Calls of what is called count, and those of what is not do not.
  CHECK(run("O1\nM98 P2\nM30\nO2\nM98 P3\nM99\nO3\n#1=[2.+\nM99\n").status == 1);
  CHECK(run("O1\nG0 X1.\nM30\nO2\nM98 P3\nGOTO 5\nM99\nO3\n#1=[2.+\nM99\n").status == 0);
  CHECK(run("O1\n#1=[2.+\nM30\nO2\nM99\n").status == 1);
  CHECK(
      has(run("O1\n#1=2\nM98 P#1\nM30\nO2\n#1=[2.+\nM99\n"), "O0002, which is in `main.nc` and has errors"));
  // Of --call the first program is the one that is called.
  CHECK(run("O9100\nG0 Z#26\nM99\nO2\n#1=[2.+\nM99\n", " --call Z1.").status == 0);
  // What belongs to no program may belong to each.
  CHECK(run("O1\nG0 X1.\nM30\nO2\nM99\n", " --limit kept-bytes=5").status != 0);
}

TEST_CASE("setup: a flag that does not say enough names what is missing") {
  const TestFolder scratch("dotek-setup-flags");
  scratch.write("part.toml", kBox);
  scratch.write("down.nc", kDown);
  scratch.write("nameless.nc", "G31 Z-1. F100\nM99\n");
  scratch.write("p.SUF", "N10 G0 X1 Y1\nN20 M30\n");
  const auto refused = [&](const std::string& command, std::string_view part) {
    CAPTURE(command);
    const CommandResult result = runIn(scratch, command);
    return result.status != 0 && has(result, part);
  };
  CHECK(refused("sim down.nc --part part.toml", "--diameter"));
  CHECK(refused("sim down.nc --tool 1", "--length 120"));
  CHECK(refused("sim down.nc --length 120", "--tool N"));
  CHECK(refused("sim down.nc --tool 1 --length 5 --work-offset G54=part", "--part PART.toml"));
  CHECK(refused("sim down.nc --work-offset G60=1,2,3", "G54 to G59"));
  CHECK(refused("sim down.nc --work-offset G54=1,2", "three numbers"));
  CHECK(refused("sim down.nc --at 1,2,3,4", "three numbers"));
  CHECK(refused("sim down.nc --tool 1 --length 5 --radius 3 --diameter 6", "the same"));
  CHECK(refused("sim down.nc --tool 1", "[setup-flag]"));
  CHECK(refused("sim nameless.nc --call \"Z1.\"", "O9100"));
  scratch.write("colon.nc", "%\n:9107(HEADED AS ON TAPES)\n#100=#1\nM99\n%\n");
  CHECK(runIn(scratch, "sim colon.nc --call \"A1.\"").status == 0);
  CHECK(runIn(scratch, "sim p.SUF --at 1,2,3").status == 0);
}

TEST_CASE("setup: a skip move to a position may meet nothing, one that measures may not") {
  const TestFolder scratch("dotek-setup-safe");
  scratch.write("part.toml", kBox);
  scratch.write("machine.toml",
                "schema = 1\n[setup]\ntool = 2\nwork_offset = { G54 = \"part\" }\nat = [-20, 20, 15]\n"
                "[probe]\nball_diameter = 6\nlength = 80\nlength_to = \"tip\"\non = true\n");
  const std::string run =
      "sim m.nc --part part.toml --machine machine.toml --call \"Z-5.\" --quiet --svg run.svg";
  const auto macro = [&](const std::string& after, const std::string& measure) {
    scratch.write("m.nc", "O9002\nG90\nG31 Z#26 F1000\n" + after + measure +
                              "G0 X-20. Z15.\nM99\nN90 #3000=1(PATH)\n" + "N91 #3000=2(NOTHING FOUND)\n");
    const CommandResult result = runIn(scratch, run);
    CHECK_MESSAGE(result.status == 0, result.err);
    return result.err + readAll(scratch / "run.svg");
  };
  const std::string touch = "G31 X5. F100\n#1=#5061\nIF[#1 GE 4.99]GOTO91\n#100=#1\n";
  const std::string safe = macro("IF[ABS[#5063-#5083-#26] GT 0.01]GOTO90\n", touch);
  CHECK(safe.find("probe-miss") == std::string::npos);
  CHECK(safe.find(">PASS<") != std::string::npos);
  const std::string flagged =
      macro("#28=0\nIF[ABS[#5063-#5083-#26] GT 0.01]THEN #28=1\nIF[#28 EQ 1]GOTO90\n", touch);
  CHECK(flagged.find("probe-miss") == std::string::npos);
  // A variable that conditions alone read is no other question.
  CHECK(macro("#5=#5063\nIF[ABS[#5-#5083-#26] GT 0.01]GOTO90\n", touch).find(">PASS<") != std::string::npos);
  // Kept, so it was to measure; and read by nobody.
  CHECK(macro("#5=#5063\nIF[ABS[#5-#5083-#26] GT 0.01]GOTO90\n#102=#5\n", touch).find("PASS, WITH MISSES") !=
        std::string::npos);
  CHECK(macro("", touch).find("[probe-miss]") != std::string::npos);
  // The measuring one finds nothing: an alarm of the macro.
  scratch.write("m.nc",
                "O9002\nG90\nG31 X-15. F100\n#1=#5061\nIF[#1 GE -15.01]GOTO91\nM99\nN91 #3000=2(NONE)\n");
  const CommandResult none = runIn(scratch, run);
  CHECK(has(none, "[probe-miss]"));
  CHECK(has(none, "3002"));
}

TEST_CASE("setup: pictures count from the end of the tool in the spindle") {
  const TestFolder scratch("dotek-setup-tool");
  scratch.write(
      "machine.toml",
      "schema = 1\n[setup]\nwork_offset = { G54 = [-300, -200, -400] "
      "}\n[probe]\ntool = 1\nball_diameter = 6\n"
      "length = 180\nlength_to = \"tip\"\non = true\n[[tool]]\nnumber = 5\nlength = 82.4\ndiameter = 10\n");
  scratch.write("m.nc", "O1\nG90 G54 G0 X0 Y0\nG53 G0 Z0\nM30\n");
  const std::string run = "sim m.nc --tool 5 --machine machine.toml --quiet --svg run.svg --html run.html";
  CHECK(runIn(scratch, run).status == 0);
  const std::string svg = readAll(scratch / "run.svg"), page = readAll(scratch / "run.html");
  CHECK(svg.find("with tool 5 it is that of the tool") != std::string::npos);
  CHECK(page.find("\"tools\":[[5,82.4,5,1]]") != std::string::npos);
  CHECK(page.find("\"spindle\":[[0,2,0]]") != std::string::npos);
  // Where the run stops: the gauge line at 0, not higher by the probe's greater length.
  scratch.write("m.nc", "O1\nG90 G54 G0 X0 Y0\nG53 G0 Z0\n#3000=1(STOP)\n");
  runIn(scratch, run);
  CHECK(readAll(scratch / "run.svg").find(", Z0.000 (gauge line); mm") != std::string::npos);
}

TEST_CASE("setup: written offsets are listed without a machine's file, and flags set what they name") {
  const TestFolder scratch("dotek-setup-offsets");
  scratch.write("m.nc", "O1\n#2007=#2007-0.05\n#500=#2007\nG10 L2 P2 X10.\nM30\n");
  const CommandResult listed = runIn(scratch, "sim m.nc --var 2007=0.2 --json");
  CHECK(has(listed, "tool 7 wear"));
  CHECK(has(listed, "G55 X"));
  CHECK(has(runIn(scratch, "sim m.nc --var 2007=0.2 --tool 7 --length 90 --json"), "\"500\": 0.15"));
}

TEST_CASE("setup: a position that is not known says which code lost it") {
  const TestFolder scratch("dotek-setup-lost");
  scratch.write("part.toml", kBox);
  scratch.write("m.nc", "O1\nG90 G54 G0 X0 Y0\nG43 H1 Z50.\nG53 G0 Z-1.\nG31 Z5. F100\nM30\n");
  const CommandResult result =
      runIn(scratch, "sim m.nc --part part.toml --tool 1 --length 80 --diameter 6 --quiet");
  CHECK(has(result, "Z is lost since `G53` in line 4"));
  CHECK(has(result, "`G49` before that one"));
}

TEST_CASE("setup: what an operator sets is refused for a program of Mikroprog, with what to do instead") {
  const TestFolder scratch("dotek-setup-suf");
  scratch.write("p.SUF", "N10 G0 X1 Y1\nN20 M30\n");
  scratch.write("machine.toml", "schema = 1\n[setup]\ntool = 2\n[probe]\nball_diameter = 6\nlength = "
                                "0\nlength_to = \"tip\"\non = true\n");
  const CommandResult result = runIn(scratch, "sim p.SUF --machine machine.toml");
  CHECK(result.status == 2);
  CHECK(has(result, "`[setup] of machine.toml`"));
  CHECK(has(result, "`length = 0`"));
}

TEST_CASE("setup: --quiet prints nothing of a good run, also where a trace goes to a file") {
  const TestFolder folder("dotek-quiet");
  const std::string trace = "--trace " + (folder.path() / "out.txt").string();
  const auto sim = [&](const std::string& more) {
    return runDotek(splitArguments("sim examples/macros/bore.nc --call \"D30. Z-5. S55\" --part "
                                   "examples/macros/plate.toml --machine examples/macros/mill.toml --at "
                                   "30,40,10 --var 520=5.97 " +
                                   more),
                    root());
  };
  CHECK(sim(trace).out.find("measured, mm") != std::string::npos);
  CHECK(sim("--quiet").out.empty());
  CHECK(sim("--quiet " + trace).out.empty());
}

TEST_CASE("setup: --active-system puts another work system in force, and --at counts in it") {
  const TestFolder scratch("dotek-setup-system");
  scratch.write("part.toml", kBox);
  scratch.write("down.nc", "O9001\n#102=#4014\nG31 Z#26 F100\n#100=#5063-#5083\n#103=#5021\nM99\n");
  const std::string stylus = "sim down.nc --part part.toml --tool 7 --length 80 --diameter 6 --json "
                             "--work-offset G56=-280,-190,-398 --call \"Z-5.\" ";
  const CommandResult out = runIn(scratch, stylus + "--at 5,6,7 --active-system 56");
  CHECK(out.status == 0);
  CHECK(has(out, "\"100\": -2,"));
  CHECK(has(out, "\"102\": 56,"));
  CHECK(has(out, "\"103\": -275"));
  CHECK(has(out, "\"system\": \"G56\""));
  CHECK(runIn(scratch, stylus + "--active-system 60").status == 2);
  CHECK(runIn(scratch, stylus + "--active-system x").status == 2);
}

TEST_CASE("setup: a macro that meets nothing names what was not said of its start") {
  const TestFolder scratch("dotek-setup-hint");
  scratch.write("part.toml", kBox);
  scratch.write("down.nc", kDown);
  const std::string stylus = "sim down.nc --part part.toml --tool 7 --length 80 --diameter 6 --quiet ";
  CommandResult out = runIn(scratch, stylus + "--call \"Z-3.\"");
  CHECK(out.status == 1);
  CHECK(has(
      out, "what the macro begins with is not said: `--at X,Y,Z` where the tool's end is before the call (it "
           "was at G54 X0.000 Y0.000 Z-80.000), `--work-offset G54=part` where its zero is"));
  out = runIn(scratch, stylus + "--work-offset G54=part --call \"Z-3.\"");
  CHECK(has(out, "(it was at G54 X300.000 Y200.000 Z320.000)\n"));
  // All is said: the miss is the program's.
  out = runIn(scratch, stylus + "--work-offset G54=part --at 90,20,5 --call \"Z-3.\"");
  CHECK(out.status == 1);
  CHECK_FALSE(has(out, "is not said"));
  // Without a part.
  out = runIn(scratch, "sim down.nc --quiet --call \"Z-3.\"");
  CHECK(has(out, "`--tool N --length L` which tool is in the spindle"));
}

TEST_CASE("setup: the page shows no number where --json has none") {
  const TestFolder scratch("dotek-setup-unknown");
  scratch.write("a.nc", "O1\nG90 G21 G54\nG0 X10. Y10.\nG30 Z0\nG0 X30.\nM30\n");
  const CommandResult out = runIn(scratch, "sim a.nc --json --html a.html");
  CHECK(has(out, "\"position\": {\"X\": 30.000000, \"Y\": 10.000000, \"Z\": null}"));
  CHECK(has(out, "\"machine\": {\"X\": 30.000000, \"Y\": 10.000000, \"Z\": null}"));
  const std::string page = readAll(scratch / "a.html");
  CAPTURE(page.substr(page.find("\"way\""), 200));
  CHECK(page.find("30,10,null]") != std::string::npos); // the end of the path
  CHECK(page.find("[\"G54\",0,0,null,4]") != std::string::npos);
  CHECK(page.find("moves without a number, or beyond 1 km: 2; they are not drawn") != std::string::npos);
  // An end that is not known any more: neither in the banner.
  scratch.write("b.nc", "O1\nG90 G21 G54\nG0 X10. Y10. Z5.\nG43 H1\nG91 G31 Z-5. F100\nM30\n");
  const CommandResult lost = runIn(scratch, "sim b.nc --json --html b.html --var 2201=100");
  CHECK(has(lost, "\"position\": {\"X\": 10.000000, \"Y\": 10.000000, \"Z\": null}"));
  CHECK(readAll(scratch / "b.html").find("G54 X10.000 Y10.000 Z?; machine X10.000 Y10.000 Z?") !=
        std::string::npos);
}
