// The tool setter: what meets it, from where, and what a program that measures a tool reads.
#include "sim/geometry/Devices.h"
#include "tests/GoldenRunner.h"

#include <doctest/doctest.h>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace fs = std::filesystem;
using namespace dotek;
using namespace dotek::tests;
using sim::Point3;
using sim::ToolSetter;

namespace {

ToolSetter disc() {
  ToolSetter out;
  out.at = {100, 50, -400};
  out.diameter = 20;
  out.overtravel = 5;
  return out;
}

// "-" where nothing is met; else the direction as a number, and the place along the path in mm.
std::string met(const Point3& from, const Point3& to, double toolRadius = 5) {
  const auto touch = sim::firstTouch(disc(), toolRadius, from, to);
  if (!touch) return "-";
  return std::to_string(touch->direction) + (touch->atStart ? " start" : "") + " " +
         std::to_string(static_cast<int>(touch->share * (to - from).length() * 1000 + 0.5));
}

constexpr std::string_view kMachine =
    "schema = 1\n[probe]\ntool = 1\nball_diameter = 6\nlength = 180\nlength_to = \"tip\"\non = true\n"
    "[[tool]]\nnumber = 5\nlength = 80\ndiameter = 10\n"
    "[tool_setter]\nat = [-50, -40, -430]\ndiameter = 20\novertravel = 5\nsignal = \"skip\"\n";

// What `sim` says of a program on that machine, with the tool in the spindle.
struct Bench {
  Bench() : folder(fs::temp_directory_path() / "dotek-tool-setter") { fs::create_directories(folder); }
  ~Bench() { fs::remove_all(folder); }
  Bench(const Bench&) = delete;
  Bench& operator=(const Bench&) = delete;
  CommandResult run(std::string_view program, const std::string& flags = "--tool 5 --length 80",
                    std::string_view machine = kMachine) const {
    std::ofstream(folder / "m.toml", std::ios::binary) << machine;
    std::ofstream(folder / "p.nc", std::ios::binary) << program;
    return runDotek(splitArguments("sim p.nc --machine m.toml --json " + flags), folder);
  }
  fs::path folder;
};

bool has(const CommandResult& result, std::string_view part) {
  CAPTURE(result.err);
  CAPTURE(result.out);
  return (result.out + result.err).find(part) != std::string::npos;
}

constexpr std::string_view kOver = "G90 G53 G0 X-50. Y-40.\nG53 G0 Z-340.\n"; // the end 10 mm above
constexpr std::string_view kRead = "G53\n#100=#5023\nM30\n";

} // namespace

TEST_CASE("tool setter: a flat end meets the disc from above and from its sides") {
  CHECK(met({100, 50, -390}, {100, 50, -410}) == "0 10000");
  CHECK(met({114.9, 50, -390}, {114.9, 50, -410}) == "0 10000"); // the rim of the tool
  CHECK(met({115.1, 50, -390}, {115.1, 50, -410}) == "-");
  CHECK(met({70, 50, -405}, {130, 50, -405}) == "1 15000");
  CHECK(met({130, 50, -405}, {70, 50, -405}) == "2 15000");
  CHECK(met({100, 20, -405}, {100, 80, -405}) == "3 15000");
  CHECK(met({100, 80, -405}, {100, 20, -405}) == "4 15000");
  CHECK(met({70, 50, -399}, {130, 50, -399}) == "-");  // above it
  CHECK(met({100, 50, -410}, {100, 50, -390}) == "-"); // away
  CHECK(met({100, 50, -400}, {100, 50, -390}) == "-");
  CHECK(met({100, 50, -400}, {100, 50, -401}) == "0 start 0");
  CHECK(met({100, 50, -401}, {120, 50, -401}) != "-"); // pressed, and dragged along
}

TEST_CASE("tool setter: G31 stops the tool's end there, and the length is what the machine position says") {
  const Bench bench;
  const std::string down = "G91 G31 Z-15. F100\nG90\n";
  const CommandResult found = bench.run(std::string(kOver) + down + std::string(kRead));
  CHECK(found.status == 0);
  CHECK(has(found, "\"100\": -350"));
  // Another tool in the offset than in the spindle measures what is there.
  CHECK(has(bench.run(std::string(kOver) + down + std::string(kRead), "--tool 5 --length 60"),
            "\"100\": -350"));
  const CommandResult broken = bench.run(std::string(kOver) + "G91 G31 Z-9. F100\nM30\n");
  CHECK(broken.status == 0);
  CHECK(has(broken, "setter-miss"));
}

TEST_CASE("tool setter: what runs into it is an error") {
  const Bench bench;
  const CommandResult rapid = bench.run(std::string(kOver) + "G53 G0 Z-355.\nM30\n");
  CHECK(rapid.status == 1);
  CHECK(has(rapid, "setter-collision"));
  CHECK(has(rapid, "in a rapid move the tool"));
  CHECK(has(bench.run(std::string(kOver) + "G91 G1 Z-11. F100\nM30\n"), "in a feed"));
  CHECK(has(bench.run("G90 G53 G0 X-80. Y-40.\nG53 G0 Z-355.\nG91 G31 X40. F100\nM30\n"), "gives no signal"));
  CHECK(has(bench.run(std::string(kOver) + "G91 G31 Z-15. F100\nG31 Z-1.\nM30\n"),
            "before the skip move begins"));
  CHECK(has(bench.run("G90 G53 G0 X-50. Y-40.\nG53 G0 Z-260.\nM30\n", "--tool 1"),
            "in a rapid move the probe"));
  CHECK(bench.run(std::string(kOver) + "G91 G31 Z-15. F100\nG0 Z5.\nM30\n").status == 0); // back off
}

TEST_CASE("tool setter: both pictures show it with its name where the run has to do with it, else say where "
          "it is") {
  const Bench bench;
  const auto drawn = [&](const std::string& program) {
    bench.run(program, "--tool 5 --length 80 --svg p.svg --html p.html");
    return readAll(bench.folder / "p.svg") + readAll(bench.folder / "p.html");
  };
  const std::string at = drawn(std::string(kOver) + "G91 G31 Z-15. F100\nG90\nM30\n");
  CHECK(at.find("class=\"setter\"") != std::string::npos);
  CHECK(at.find(">tool setter</text>") != std::string::npos);
  CHECK(at.find("at machine X-50.000 Y-40.000 Z-430.000") != std::string::npos);
  CHECK(at.find("\"setter\":{\"at\":[-50,-40,-430],\"radius\":10}") != std::string::npos);
  CHECK(at.find("outside of the picture") == std::string::npos);
  CHECK(at.find("nothing could be touched") == std::string::npos); // it was
  const std::string away = drawn("G90 G53 G0 X-500. Y-400.\nG53 G1 X-490. F100\nM30\n");
  CHECK(away.find("class=\"setter\"") == std::string::npos);
  CHECK(away.find("tool setter, outside of the picture") != std::string::npos);
}

TEST_CASE("tool setter: M6 puts the tool in the spindle; one that nobody describes ends the run") {
  const Bench bench;
  const std::string down = std::string(kOver) + "G91 G31 Z-15. F100\nG90\n" + std::string(kRead);
  CHECK(has(bench.run("T5 M6\n" + down, "--tool 1"), "\"100\": -350"));
  const CommandResult unknown = bench.run("T9\nM6\n" + down, "--tool 1");
  CHECK(unknown.status == 1);
  CHECK(has(unknown, "[[tool]]"));
  const std::string sides = std::string(kMachine) + "directions = [\"+X\"]\n";
  CHECK(bench
            .run("G90 G53 G0 X-80. Y-40.\nG53 G0 Z-355.\nG91 G31 X40. F100\nM30\n", "--tool 5 --length 80",
                 sides)
            .status == 0);
  const std::string bad =
      "schema = 1\n[probe]\nball_diameter = 6\nlength = 180\nlength_to = \"tip\"\non = true\n"
      "[tool_setter]\nat = [1, 2]\ndiameter = 20\novertravel = 5\nsignal = \"m88\"\n";
  const CommandResult refused = bench.run("M30\n", "", bad);
  CHECK(refused.status != 0);
  CHECK(has(refused, "[X, Y, Z]"));
  CHECK(has(refused, "skip"));
}

TEST_CASE("first run: a work system and a tool length that nobody has set are named with their flags") {
  const Bench bench;
  std::ofstream(bench.folder / "part.toml", std::ios::binary)
      << "schema = 1\n[place]\nshift = [-300.0, -200.0, -400.0]\n[[shape]]\nkind = \"box\"\nmin = [0, 0, "
         "-20]\n"
         "max = [50, 50, 0]\n";
  const std::string probe = "G90 G54 G0 X10. Y10.\nG43 H1 Z50.\nG31 Z-5. F100\nM30\n";
  std::string unknown(kMachine); // no tool number says which length the table is to have
  unknown.erase(unknown.find("tool = 1\n"), 9);
  const CommandResult first = bench.run(probe, "--part part.toml", unknown);
  CHECK(has(first, "work-offset-not-set"));
  CHECK(has(first, "tool-length-not-set"));
  CHECK(has(first, "--work-offset G54=part"));
  CHECK(has(first, "--tool 1 --length 180"));
  const CommandResult second = bench.run(probe, "--part part.toml --work-offset G54=part --tool 1");
  CHECK(second.status == 0);
  CHECK_FALSE(has(second, "not-set"));
  // The machine's file says which tool the probe is.
  CHECK_FALSE(has(bench.run(probe, "--part part.toml --work-offset G54=part"), "tool-length-not-set"));
  CHECK(has(bench.run("O1\nIF[#26 EQ #0]THEN #3000=1(NO Z)\nG31 Z#26 F#9\nM99\n", ""), "--call"));
}

TEST_CASE("tool setter: a tool that runs into it with an empty offset names the offset, and how to set it") {
  const Bench bench;
  const std::string into = std::string(kOver) + "G53 G0 Z-355.\nM30\n";
  const CommandResult empty = bench.run("T5 M6\n" + into, "");
  CHECK(empty.status == 1);
  CHECK(has(empty, "setter-collision"));
  CHECK(has(empty, "tool offset 5 (H5) is 0, and tool 5 is 80 mm long"));
  CHECK(has(empty, "tools = [{ number = 5, length = 80 }]"));
  const CommandResult filled = bench.run("T5 M6\n" + into, "--var 2205=80");
  CHECK(has(filled, "setter-collision"));
  CHECK(filled.out.find("(H5) is 0") == std::string::npos);
}

TEST_CASE("tool setter: a run that it gave no signal says nothing of a missing part, and draws no ball of "
          "the probe") {
  const Bench bench;
  const CommandResult out = bench.run(std::string(kOver) + "G91 G31 Z-9. F100\nM30\n",
                                      "--tool 5 --length 80 --svg p.svg --html p.html");
  CHECK(out.status == 0);
  const std::string drawn = readAll(bench.folder / "p.svg") + readAll(bench.folder / "p.html");
  CHECK(drawn.find("PASS, WITH MISSES") != std::string::npos);
  CHECK(drawn.find("nothing could be touched") == std::string::npos);
  const std::string svg = readAll(bench.folder / "p.svg");
  CHECK(svg.find("stroke-opacity=\"0.7\" clip-path=\"url(#clip0)\">\n</g>") != std::string::npos);
}

TEST_CASE(
    "a run without a part ends at the G31 of its block, and --report without a device names the pictures") {
  const Bench bench;
  std::ofstream(bench.folder / "q.nc", std::ios::binary) << "G21 G17\nG90 G31 Z-5. F100\nM30\n";
  const CommandResult out = runDotek(splitArguments("sim q.nc --quiet"), bench.folder);
  CHECK(has(out, "q.nc:2:5: error: `G31`: no part is given"));
  const CommandResult report = runDotek(splitArguments("sim q.nc --report r.md"), bench.folder);
  CHECK(report.status != 0);
  CHECK(has(report, "`--svg OUT` (to print) and `--html OUT`"));
}

TEST_CASE("tool setter: an offset that is not the length of the tool fails the run") {
  const Bench bench;
  // The setter's face lies at Z-430 of the machine.
  const std::string touch =
      "O1\nG21 G90 G94 G17 G40 G80\nG53 G0 X-50. Y-40.\nG49\nG53 Z-340.\nG91 G31 Z-15. F100\n"
      "G90\n";
  const CommandResult right = bench.run(touch + "#2205=#5023+430.\nM30\n");
  CHECK_FALSE(has(right, "tool-offset-not-length"));
  const CommandResult turned = bench.run(touch + "#2205=-430.-#5023\nM30\n");
  CHECK(turned.status == 1);
  CHECK(has(
      turned,
      "the offset of tool 5 is -80.000 at the end of the run, and the tool is 80.000 mm long (-160.000)"));
  // What counts from somewhere else.
  CHECK(has(bench.run(touch + "#2205=#5023+530.\nM30\n"), "is 180.000 at the end of the run"));
  // Set back and measured: what it is in between is nobody's business.
  CHECK_FALSE(has(bench.run(touch + "#2205=0\n#2205=#5023+430.\nM30\n"), "tool-offset-not-length"));
  // Another shop counts from the table: the offset never was the length.
  CHECK_FALSE(
      has(bench.run(touch + "#2205=#5023+400.\nM30\n", "--tool 5 --length 50"), "tool-offset-not-length"));
}
