// What a report of a run holds beside its path: variables that are named, printed text, touches in one row.
#include "tests/GoldenRunner.h"
#include "tests/TestFolder.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

using namespace dotek::tests;
using Json = nlohmann::json;

namespace {

constexpr const char* kMachine = "schema = 1\n[start]\nz = 50.0\n[probe]\nball_diameter = 6.0\nlength = 0.0\n"
                                 "length_to = \"tip\"\novertravel = 5.0\non = true\n";
constexpr const char* kPart = "schema = 1\n[[shape]]\nkind = \"box\"\nmin = [0.0, 0.0, -20.0]\n"
                              "max = [100.0, 100.0, 0.0]\n";

struct Run {
  explicit Run(const char* folder) : folder_(folder) {
    folder_.write("machine.toml", kMachine);
    folder_.write("part.toml", kPart);
  }
  CommandResult operator()(const std::string& program, std::vector<std::string> more = {}) {
    folder_.write("p.nc", program);
    std::vector<std::string> arguments = {"sim",       "p.nc",   "--machine", "machine.toml", "--part",
                                          "part.toml", "--html", "p.html",    "--svg",        "p.svg"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return runDotek(arguments, folder_.path());
  }
  std::string read(const char* name) const { return readAll(folder_ / name); }
  std::string pages() const { return read("p.html") + read("p.svg"); }

  TestFolder folder_;
};

bool has(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

std::size_t countOf(const std::string& text, const std::string& what) {
  std::size_t out = 0;
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += what.size())
    ++out;
  return out;
}

constexpr const char* kWidth = "O7\nG90 G21 G54\nG0 X-20. Y50. Z-5.\nG31 X5. F100\n#131=#5061+3.\nG0 X-20.\n"
                               "#132=100.-#131\nM30\n";

} // namespace

TEST_CASE("sim report: --show names a variable of the program in the table, beside what is expected") {
  Run run("dotek-report-show");
  const CommandResult shown = run(kWidth, {"--show", "131=EDGE,#132=LENGTH=99.5", "--show", "140=NEVER=1"});
  CHECK_MESSAGE(shown.status == 0, shown.err);
  CHECK(has(shown.out, "\nresults (p.nc:8, in G54)\n"));
  CHECK(has(shown.out, "  EDGE (#131)                             -        0.000            -\n"));
  CHECK(has(shown.out, "  LENGTH (#132)                      99.500      100.000       +0.500\n"));
  CHECK(has(shown.out, "  NEVER (#140)                        1.000        empty            -\n"));
  CHECK(countOf(run.pages(), "LENGTH (#132)") == 2);
  const Json measured = Json::parse(run(kWidth, {"--show", "132=L=99.5,140=N", "--json"}).out)["measured"];
  const Json values = measured.back()["values"];
  REQUIRE(values.size() == 2);
  CHECK(values[0] == Json{{"name", "L (#132)"}, {"nominal", 99.5}, {"measured", 100.0}, {"deviation", 0.5}});
  CHECK(values[1]["measured"] == nullptr);
  // Of a macro that is called, and where nothing is touched.
  const CommandResult called =
      runDotek({"sim", "p.nc", "--show", "131=A", "--call", " "}, run.folder_.path());
  CHECK(called.status == 1);
  run("O8\n#149=12.5\nM99\n");
  CHECK(has(runDotek({"sim", "p.nc", "--show", "149=A", "--call", " "}, run.folder_.path()).out,
            "A (#149)                                -       12.500"));
}

TEST_CASE("sim report: what a call of our own macros expects is its nominal, and G20 is said of --show") {
  Run run("dotek-report-nominal");
  const std::string setup = "O9\n#520=3.\n#521=200.\n#522=50.\n#523=1.\nG43 H1\n";
  const CommandResult own = run(setup + "G0 X-12. Y20.\nZ-8.\nG65 P8811 X0.2\nG0 Z30.\nX50. Y50.\n"
                                        "G65 P8812 X99.5 Z-8. R5.\nG0 Z30.\nM30\n");
  CAPTURE(own.err);
  CHECK(own.status == 0);
  CHECK(has(own.out, "  X                                   0.200        0.000       -0.200\n"));
  CHECK(has(own.out, "  width                              99.500      100.000       +0.500\n"));
  const std::string shown = run("O9\n#131=1.182\nG20\nM30\n", {"--show", "131=DIA=1.1811"}).out;
  CHECK(has(shown, "a length in inches (G20)"));
  CHECK_FALSE(has(run("O9\n#131=1.182\nM30\n", {"--show", "131=DIA=1.1811"}).out, "inches"));
}

TEST_CASE("sim report: --show takes common variables alone") {
  Run run("dotek-report-show-flags");
  const auto refused = [&](const char* flag, std::string_view why) {
    const CommandResult result = run(kWidth, {"--show", flag});
    CAPTURE(result.err);
    return result.status != 0 && has(result.err, why) && has(result.err, "--show") &&
           (has(result.err, "[show-flag]") || has(result.err, "NAME=VALUE"));
  };
  CHECK(refused("5=X", "#5 is no common variable"));
  CHECK(refused("5221=X", "#5221 is no common variable"));
  CHECK(refused("131=", "NUMBER=NAME"));
  CHECK(refused("X=131", "NUMBER=NAME"));
  CHECK(refused("131", "NAME=VALUE"));
  CHECK(refused("131=D=ten", "no number"));
  run.folder_.write("c.cycle", "cycle c \"C\"\n\nstop \"HERE\"\n");
  CHECK(has(runDotek({"sim", "c.cycle", "--show", "131=D"}, run.folder_.path()).err, "`--show` is for"));
}

TEST_CASE("sim report: each touch of a cycle has a row of its own, at its line") {
  Run run("dotek-report-touches");
  run.folder_.write("two.cycle",
                    "cycle two \"Two\"\n\nresult p : length \"p\"\n\nprobe on\n"
                    "touch x by 10 mm -> side\ntouch x by 10 mm -> side\nprobe off\np = side.at\n");
  const CommandResult out = runDotek({"sim", "two.cycle"}, run.folder_.path());
  CAPTURE(out.out);
  CHECK(has(out.out, "two.cycle:6"));
  CHECK(has(out.out, "two.cycle:7"));
}

TEST_CASE("sim report: a coordinate that another system gets is no nominal value of the active one") {
  Run run("dotek-report-other-system");
  run.folder_.write("part.toml",
                    "schema = 1\n[[shape]]\nkind = \"box\"\nmin = [-50.0, -50.0, -20.0]\n"
                    "max = [100.0, 100.0, 0.0]\n[[shape]]\nkind = \"hole\"\nat = [25.0, 40.0, 0.0]\n"
                    "through = true\nradius = 12.0\n");
  const auto bore = [&](const std::string& system) {
    return run("O7\nG90 G21 G54\nG0 X25. Y40.\nG0 Z-5.\nG65 P9023 I0 J0 D24. S" + system + "\nM30\n",
               {"--control", "fanuc-31i-b", "--probe-macros", "easyprobe"})
        .out;
  };
  CAPTURE(bore("55."));
  CHECK(has(bore("55."), "25.000            -"));
  CHECK_FALSE(has(bore("55."), "+25.000\n"));
  CHECK(has(bore("54."), "+25.000\n"));
}

TEST_CASE("sim report: radii of tools that are written are in the table, by variable and by G10") {
  Run run("dotek-report-radii");
  const auto written = [&](const std::string& blocks) {
    const CommandResult out =
        run("O7\nG90 G21\n" + blocks + "\nM30\n", {"--control", "fanuc-31i-b", "--var", "12005=0.02"});
    CAPTURE(out.err);
    CHECK(out.status == 0);
    return out.out + run.read("p.svg");
  };
  CHECK(has(written("#12005=#12005-0.05"), "tool 5 radius wear set from 0.020 to -0.030"));
  CHECK(has(written("#13005=6."), "tool 5 radius geometry set from 0.000 to 6.000"));
  CHECK(has(written("G10 L13 P5 R0.04"), "tool 5 radius wear set from 0.020 to 0.040"));
  CHECK(has(written("G91 G10 L13 P5 R0.04"), "tool 5 radius wear set from 0.020 to 0.060"));
  CHECK(has(written("G10 L12 P5 R5.5\n#11005=#13005*2"), "tool 5 geometry set from 0.000 to 11.000"));
  // Under G20 they are inches, as other offsets are.
  CHECK(has(written("G20\n#13005=0.25\nG21"), "tool 5 radius geometry set from 0.000 to 6.350"));
  run("O7\nG10 L12 P5 R5.5\nM30\n", {"--control", "haas-ngc"});
  CHECK(has(run.pages(), "names no variables with offsets of a tool&#39;s radius"));
}

TEST_CASE("sim report: what the program prints is on both pictures") {
  Run run("dotek-report-printed");
  const CommandResult one = run("O7\n#101=12.5\nPOPEN\nDPRNT[BORE*A*X#101[53]]\nDPRNT[END]\nPCLOS\nM30\n",
                                {"--control", "fanuc-31i-b"});
  CHECK_MESSAGE(!has(one.err, "error"), one.err);
  for (const char* name : {"p.html", "p.svg"}) {
    const std::string page = run.read(name);
    CHECK_MESSAGE(has(page, "id=\"printed\""), name);
    CHECK_MESSAGE(has(page, "END"), name);
  }
  CHECK(has(run.read("p.html"), "BORE A"));
  run("O7\n#101=12.5\n#1=3.\nM30\n");
  CHECK_FALSE(has(run.pages(), "id=\"printed\""));
  // So is what it leaves, unless --show chooses.
  CHECK(countOf(run.pages(), "#101 = 12.500") == 2);
  CHECK_FALSE(has(run.pages(), "#1 = "));
  run("O7\n#101=12.5\nG68 X0 Y0 R0.25\nM30\n", {"--show", "101=A"});
  CHECK_FALSE(has(run.pages(), "#101 = "));
  CHECK(countOf(run.pages(), "G68 R0.25 in force") == 2);
}

TEST_CASE("sim report: a variable that nobody has set is reported where it is printed alone") {
  Run run("dotek-report-unset");
  const std::string program = "O7\n#110=1.5\nPOPEN\nDPRNT[A#110[43]]\nDPRNT[BORE*X#115[43]]\nPCLOS\nM30\n";
  const CommandResult result = run(program);
  CHECK(result.status == 0);
  CHECK(has(result.err, "p.nc:5:1: warning"));
  CHECK(has(result.err, "#115"));
  CHECK_FALSE(has(result.err, "#110"));
  CHECK(has(run.read("p.svg"), "PASS, WITH VALUES MISSING"));
  CHECK_FALSE(has(run(program, {"--var", "115=2"}).err, "#115"));
}

TEST_CASE("sim report: a ball that meets an edge is reported, and the run is no plain PASS") {
  Run run("dotek-report-edge");
  const auto at = [&](const std::string& z) {
    return run("O7\nG90 G21 G54\nG0 X-20. Y50.\nG0 Z" + z + "\nG31 X5. F100\n#101=#5061\nG0 X-20.\nM30\n");
  };
  // Z is the end of the stylus, its ball has a radius of 3: its centre is at +1, and the edge at 0.
  const CommandResult edge = at("-2.");
  CHECK(edge.status == 0);
  CHECK(has(edge.err, "p.nc:5:1: warning: the ball meets an edge"));
  CHECK(has(edge.err, "[edge-touched]"));
  CHECK(has(edge.err, "0.172 mm farther")); // 3 - sqrt(9 - 1)
  CHECK(has(run.read("p.svg"), ">PASS, AN EDGE TOUCHED<"));
  // What is measured is off by what the effective radius makes of it.
  run.folder_.write("machine.toml", std::string(kMachine) + "effective_radius = 2.95\n");
  CHECK(has(at("-2.").err, "0.175 mm farther")); // 2.95 - sqrt(2.95^2 - 1)
  run.folder_.write("machine.toml", kMachine);
  at("-2.");
  // The mark is where the ball was, and not where the move began.
  CHECK(has(run.read("p.svg"), "G54 X-2.828 Y50.000 Z-2.000"));
  CHECK_FALSE(has(at("-3.01").err, "edge"));
  CHECK(has(run.read("p.html"), "<strong>PASS</strong>"));
  // The rim of a bore, and its wall, which is bent.
  run.folder_.write("part.toml",
                    "schema = 1\n[[shape]]\nkind = \"box\"\nmin = [0.0, 0.0, -20.0]\n"
                    "max = [100.0, 100.0, 0.0]\n[[shape]]\nkind = \"hole\"\nat = [50.0, 50.0, 0.0]\n"
                    "through = true\nradius = 8.0\n");
  const auto bore = [&](const std::string& z) {
    return run("O7\nG90 G21 G54\nG0 X51. Y52.\nG0 Z" + z + "\nG31 X70. F100\n#101=#5061\nG0 X51.\nM30\n");
  };
  CHECK(has(bore("-2.").err, "the ball meets an edge"));
  CHECK_FALSE(has(bore("-9.").err, "edge"));
}

TEST_CASE(
    "sim report: the wear of a tool that moves by the error of the face, and to its side, is reported") {
  Run run("dotek-report-wear");
  run.folder_.write("part.toml", "schema = 1\n[[shape]]\nkind = \"box\"\nmin = [0.0, 0.0, -20.0]\n"
                                 "max = [100.0, 100.0, 0.015]\n");
  const auto update = [&](const std::string& value, const std::string& more = "") {
    return run("O9205\n" + more +
                   "G90 G21 G54\nG0 X50. Y50. Z10.\nG31 Z[#26-5.] F50\n#101=#5063-#26\nG0 Z10.\n" + value +
                   "\nM99\n",
               {"--call", "Z0. T7."});
  };
  const CommandResult wrong = update("#[2000+#20]=#[2000+#20]+#101");
  CHECK(wrong.status == 0);
  CHECK(has(wrong.err, "warning: tool 7 wear is set from 0.000 to 0.015"));
  CHECK(has(wrong.err, "too high"));
  CHECK(has(wrong.err, "[wear-wrong-way]"));
  CHECK(has(run.read("p.svg"), "PASS, WEAR THE WRONG WAY"));
  CHECK_FALSE(has(update("#[2000+#20]=#[2000+#20]-#101").err, "wear"));
  CHECK(has(run.read("p.html"), "<strong>PASS</strong>"));
}

TEST_CASE("sim report: a zero of the machine's file that counts with a part alone is named where it lacks") {
  Run run("dotek-report-zero");
  run.folder_.write("mill.toml",
                    std::string("[travel]\nx = [-300.0, 0.0]\nz = [-400.0, 0.0]\n") +
                        "[setup]\nwork_offset = { G54 = \"part\" }\n[probe]\nball_diameter = 6.0\n"
                        "length = 80.0\nlength_to = \"tip\"\non = true\n");
  run.folder_.write("mill.toml", "schema = 1\n" + readAll(run.folder_ / "mill.toml"));
  run.folder_.write("q.nc", "O7\nG90 G54 G0 X20.\nM30\n");
  const CommandResult over = runDotek({"sim", "q.nc", "--machine", "mill.toml"}, run.folder_.path());
  CHECK(over.status == 1);
  CHECK(has(over.err, "over-travel"));
  CHECK(has(over.err, "`mill.toml` puts G54 where the part is, and no part is given"));
  const CommandResult start =
      runDotek({"sim", "q.nc", "--machine", "mill.toml", "--at", "30,40,3"}, run.folder_.path());
  CHECK(start.status != 0);
  CHECK(has(start.err, "`mill.toml` puts G54 where the part is, and no part is given"));
  CHECK_FALSE(has(start.err, "which nothing has set"));
}

TEST_CASE("sim report: a fast touch whose skip position nothing reads is no row beside the slow one") {
  Run run("dotek-report-approach");
  const std::string begin = "O7\nG90 G21 G54\nG0 X-20. Y50. Z-5.\n";
  const std::string twice =
      begin + "G31 X5. F500\nG91 G0 X-1.\nG31 X3. F30\nG90\n#101=#5061\nG0 X-20.\nM30\n";
  const Json measured = Json::parse(run(twice, {"--json"}).out)["measured"];
  REQUIRE(measured.size() == 1);
  CHECK(measured[0]["place"] == "p.nc:6");
  // One that is read is a measurement: of the same place it says so.
  const std::string read = begin + "G31 X5. F500\n#100=#5061\nG91 G0 X-1.\nG31 X3. F30\nG90\n#101=#5061\n"
                                   "G0 X-20.\nM30\n";
  const Json both = Json::parse(run(read, {"--json"}).out)["measured"];
  REQUIRE(both.size() == 2);
  CHECK(both[0]["feature"] == "touch along X+");
  CHECK(both[1]["feature"] == "touch along X+ again");
  CHECK(has(run(read).out, "touch along X+ again, skip position (p.nc:7"));
  // Nor is it one beside another place of the face, or another way.
  const std::string beside =
      begin + "G31 X5. F500\nG0 X-20.\nY60.\nG31 X5.\nG0 X-20.\nZ20.\nX10.\nG31 Z-4.\nG0 Z30.\nM30\n";
  const Json three = Json::parse(run(beside, {"--json"}).out)["measured"];
  REQUIRE(three.size() == 3);
  CHECK(three[1]["feature"] == "touch along X+");
}

TEST_CASE("sim report: lengths without a point on a control that counts increments are noted once") {
  Run run("dotek-report-point");
  const std::string program = "O7\n#1=1\nG90 G54 G0 X10 Y-20.\nZ5\nM30\n";
  const CommandResult old = run(program, {"--control", "fanuc-6m"});
  CHECK(has(old.err, "p.nc:3:1: note: a length here has no point"));
  CHECK(has(old.err, "`X10` is 0.010 mm; so it is with 1 more"));
  CHECK(countOf(old.err, "word-without-point") == 1);
  CHECK_FALSE(has(run("O7\n#1=1\nG90 G54 G0 X10. Y0\nM30\n", {"--control", "fanuc-6m"}).err, "no point"));
}
