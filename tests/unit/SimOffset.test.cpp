// Cutter compensation as motion: expected positions are computed by hand from the rule of docs/sim.md.
#include "SimHarness.h"

#include <vector>

using namespace dotek;
using tests::Simulation;

namespace {

struct Path {
  explicit Path(double radius, bool round = false) {
    run.machine->roundOffsetCorners(round);
    REQUIRE(run.machine->preset(13001, radius));
    run.machine->setTrace(&trace);
  }
  // Lines of the trace, without axes and feeds that stay as they are: "feed -5 55", "arc-cw 5 0 centre 0 0".
  std::vector<std::string> of(std::string_view text) {
    run.run(text);
    if (run.machine->running()) run.machine->finish();
    trace.flush();
    std::vector<std::string> out;
    std::size_t at = 0;
    while (at < written.size()) {
      const std::size_t end = written.find('\n', at);
      out.push_back(shorter(written.substr(at, end - at)));
      at = end + 1;
    }
    return out;
  }
  std::string written;
  sim::Trace trace{[this](std::string_view text) { written += text; }};
  Simulation run;

private:
  // Numbers without zeros at their end, words without F.
  static std::string shorter(const std::string& line) {
    std::string out;
    std::size_t at = 0;
    while (at <= line.size()) {
      const std::size_t end = std::min(line.find(' ', at), line.size());
      std::string word = line.substr(at, end - at);
      at = end + 1;
      if (word.find('.') != std::string::npos) {
        while (word.back() == '0')
          word.pop_back();
        if (word.back() == '.') word.pop_back();
      }
      if (word.starts_with('F') && word.size() > 1) continue;
      out += (out.empty() ? "" : " ") + word;
    }
    return out;
  }
};

using Lines = std::vector<std::string>;

class Motions : public sim::MotionWatcher {
public:
  void moved(const sim::MachineMotion& motion) override { all.push_back(motion); }
  std::vector<sim::MachineMotion> all;
};

std::string stateOf(std::string_view text, double radius = 5) {
  Path path(radius);
  path.of(text);
  const sim::RunEnd& end = path.run.machine->end();
  if (end.ending == sim::Ending::Alarm) return fmt::format("line {}: {}", end.line, end.text.substr(0, 12));
  return path.run.state() + (end.text.empty() ? "" : ": " + end.text);
}

} // namespace

TEST_CASE("sim offset: outside corners are prolonged as a Fanuc does by default") {
  CHECK(Path(5).of("G0 X0 Y-20.\nG41 D1 G1 Y-10. F100\nY50.\nX50.\nY0\nG40 X60.\nM30") ==
        Lines{"rapid X0 Y-20 Z0", "comp left D1", "feed X-5 Y-10 Z0", "feed X-5 Y55 Z0", "feed X55 Y55 Z0",
              "feed X55 Y0 Z0", "comp off", "feed X60 Y0 Z0", "end"});
  // A turn of 135 degrees: each tangent goes on by the radius.
  CHECK(Path(5).of("G0 X0 Y-20.\nG41 D1 G1 Y-10. F100\nY50.\nX50. Y0\nG40 X60. Y-10.\nM30") ==
        Lines{"rapid X0 Y-20 Z0", "comp left D1", "feed X-5 Y-10 Z0", "feed X-5 Y55 Z0",
              "feed X0 Y57.071068 Z0", "feed X53.535534 Y3.535534 Z0", "comp off", "feed X60 Y-10 Z0",
              "end"});
}

TEST_CASE("sim offset: outside corners as arcs, where the machine is set so") {
  CHECK(Path(5, true).of("G0 X0 Y-20.\nG41 D1 G1 Y-10. F100\nY50.\nX50. Y0\nG40 X60. Y-10.\nM30") ==
        Lines{"rapid X0 Y-20 Z0", "comp left D1", "feed X-5 Y-10 Z0", "feed X-5 Y50 Z0",
              "arc-cw xy X3.535534 Y53.535534 Z0 centre 0 50", "feed X53.535534 Y3.535534 Z0", "comp off",
              "feed X60 Y-10 Z0", "end"});
}

TEST_CASE("sim offset: inside corners end where the offset moves meet") {
  CHECK(Path(5).of("G0 X0 Y-20.\nG42 D1 G1 Y-10. F100\nY50.\nX50.\nG40 X60.\nM30") ==
        Lines{"rapid X0 Y-20 Z0", "comp right D1", "feed X5 Y-10 Z0", "feed X5 Y45 Z0", "feed X50 Y45 Z0",
              "comp off", "feed X60 Y50 Z0", "end"});
  // Line to arc: the tool's centre is 5 right of X0, and 25 from the centre of the arc, 20 about X20 Y50.
  CHECK(Path(5).of("G0 X0 Y-20.\nG42 D1 G1 Y-10. F100\nY50.\nG2 X40. Y50. R20.\nG1 Y0\nG40 Y-10.\nM30") ==
        Lines{"rapid X0 Y-20 Z0", "comp right D1", "feed X5 Y-10 Z0", "feed X5 Y50 Z0",
              "arc-cw xy X35 Y50 Z0 centre 20 50", "feed X35 Y0 Z0", "comp off", "feed X40 Y-10 Z0", "end"});
  // A negative offset is on the other side.
  CHECK(Path(-5).of("G0 X0 Y-20.\nG41 D1 G1 Y-10. F100\nY50.\nX50.\nG40 X60.\nM30").at(3) ==
        "feed X5 Y45 Z0");
}

TEST_CASE(
    "sim offset: it begins and ends at a right angle to the first and the last move beside it (type A)") {
  CHECK(Path(5).of("G0 X-30. Y-20.\nG41 D1 G1 X0 Y0 F100\nY50.\nG40 X-30. Y60.\nM30") ==
        Lines{"rapid X-30 Y-20 Z0", "comp left D1", "feed X-5 Y0 Z0", "feed X-5 Y50 Z0", "comp off",
              "feed X-30 Y60 Z0", "end"});
  // One axis is named, both move.
  CHECK(Path(5).of("G41 D1 G1 Y10. F100\nY50.\nG40 Y60.\nM30").at(4) == "feed X0 Y60 Z0");
  // G40 alone: beside the path until a move in the plane.
  CHECK(Path(5).of("G41 D1 G1 Y10. F100\nY50.\nG40\nG0 Z100.\nX20. Y60.\nM30") ==
        Lines{"comp left D1", "feed X-5 Y10 Z0", "feed X-5 Y50 Z0", "comp off", "rapid X-5 Y50 Z100",
              "rapid X20 Y60 Z100", "end"});
  // Never ended: the last move ends beside its end.
  CHECK(Path(5).of("G41 D1 G1 Y10. F100\nY50.\nM30") ==
        Lines{"comp left D1", "feed X-5 Y10 Z0", "feed X-5 Y50 Z0", "end"});
  CHECK(Path(5).of("G41 D1 G1 Y10. F100\nY50.\n%").back() == "feed X-5 Y50 Z0");
}

TEST_CASE("sim offset: a move along the third axis, and codes between, keep their places") {
  CHECK(Path(5).of("G41 D1 G1 Y10. F100\nZ-3.\nY50.\nM8\nX50.\nG40 X60.\nM30") ==
        Lines{"comp left D1", "feed X-5 Y10 Z0", "feed X-5 Y10 Z-3", "feed X-5 Y55 Z-3", "coolant flood",
              "feed X50 Y55 Z-3", "comp off", "feed X60 Y50 Z-3", "end"});
  // A helix keeps its way down.
  CHECK(Path(5).of("G41 D1 G1 Y10. F100\nY50.\nG2 X20. Y70. I20. Z-2.\nG1 X30.\nG40 X40.\nM30").at(3) ==
        "arc-cw xy X20 Y75 Z-2 centre 20 50");
}

TEST_CASE("sim offset: planes ZX and YZ") {
  // Along Z, then X: a turn to the left.
  CHECK(Path(5).of("G18\nG0 Z-20.\nG41 D1 G1 Z-10. F100\nZ50.\nX50.\nG40 X60.\nM30") ==
        Lines{"rapid X0 Y0 Z-20", "comp left D1", "feed X5 Y0 Z-10", "feed X5 Y0 Z45", "feed X50 Y0 Z45",
              "comp off", "feed X60 Y0 Z50", "end"});
  CHECK(Path(5).of("G19\nG0 Y-20.\nG41 D1 G1 Y-10. F100\nY50.\nZ50.\nG40 Z60.\nM30").at(3) ==
        "feed X0 Y45 Z5");
}

TEST_CASE("sim offset: interference is an alarm at the move that does not fit") {
  // A slot of 6 with a tool of 10.
  CHECK(stateOf("G0 Y-20.\nG42 D1 G1 Y-10. F100\nY50.\nX6.\nY0\nG40 Y-10.\nM30") == "line 4: interference");
  // A slot of 10 is just wide enough.
  CHECK(stateOf("G0 Y-20.\nG42 D1 G1 Y-10. F100\nY50.\nX10.\nY0\nG40 Y-10.\nM30") == "end");
  CHECK(stateOf("G0 Y-20.\nG41 D1 G1 Y-10. F100\nY50.\nG3 X-10. Y50. R5.\nG1 Y0\nG40 Y-10.\nM30") ==
        "line 4: interference");
  CHECK(stateOf("G0 Y-20.\nG41 D1 G1 Y-10. F100\nY50.\nG3 X-12. Y50. R6.\nG1 Y0\nG40 Y-10.\nM30") == "end");
  CHECK(stateOf("G41 D1 G2 X10. Y10. R10. F100\nY50.").starts_with("line 1: an arc at th"));
}

TEST_CASE("sim offset: what ends a run there") {
  CHECK(stateOf("G41 D1 G1 Y10. F100\nY50.\nG42 Y60.").starts_with("inconclusive G: the other side under"));
  CHECK(stateOf("G41 D1 G1 Y10. F100\nY50.\nD2 Y60.").starts_with("inconclusive D: another offset under"));
  CHECK(stateOf("G41 D1 G1 Y10. F100\nY50.\nG18 X60.").starts_with("inconclusive G: another plane under"));
  CHECK(stateOf("G41 D1 G1 Y10. F100\nY50.\nG55 X60.").starts_with("inconclusive G: another work system"));
  CHECK(
      stateOf("G41 D1 G1 Y10. F100\nY50.\nG81 X60. R1. Z-1.").starts_with("inconclusive G: a canned cycle"));
  CHECK(stateOf("G41 D1 G1 Y10. F100\nY50.\nG28 X0").starts_with("inconclusive G: a code that is no plain"));
  CHECK(stateOf("G41 D1 G1 Y10. F100\nY50.\nT1 M6").starts_with("inconclusive M: a tool change under"));
  // Several blocks beside the plane hide the corner; where there is none, they do not matter.
  CHECK(stateOf("G41 D1 G1 Y10. F100\nY50.\nZ-1.\nM8\nX50.").starts_with("inconclusive G: between this"));
  CHECK(stateOf("G41 D1 G1 Y10. F100\nZ-1.\nM8\nY50.\nM9\nM5\nG40 Y60.\nM30") == "end");
  // #5041 is not known as long as the tool is beside the path; #5001 is.
  Path path(5);
  path.of("G41 D1 G1 Y10. F100\nY50.");
  CHECK(path.run.machine->position()[1] == 50);
}

TEST_CASE("sim offset: without a radius the path is that of the program") {
  CHECK(Path(0).of("G41 D1 G1 Y10. F100\nY50.\nX50.\nG40 X60.\nM30") ==
        Lines{"comp left D1", "feed X0 Y10 Z0", "feed X0 Y50 Z0", "feed X50 Y50 Z0", "comp off",
              "feed X60 Y50 Z0", "end"});
  CHECK(Path(5).of("G41 D0 G1 Y10. F100\nY50.\nX50.\nM30").at(2) == "feed X0 Y50 Z0");
  // Wear is added to the geometry.
  Path worn(5);
  REQUIRE(worn.run.machine->preset(12001, -0.5));
  CHECK(worn.of("G41 D1 G1 Y10. F100\nY50.\nX50.\nG40 X60.\nM30").at(2) == "feed X-4.5 Y54.5 Z0");
}

TEST_CASE("sim offset: who watches sees the offset path in coordinates of the machine") {
  Path path(5);
  Motions motions;
  path.run.machine->setZero(0, {100, 200, -50});
  path.run.machine->setWatcher(&motions);
  path.of("G0 X0 Y-20.\nG41 D1 G1 Y-10. F100\nY50.\nX50.\nG40 X60.\nM30");
  REQUIRE(motions.all.size() == 5);
  CHECK(motions.all[1].to[0] == 95);
  CHECK(motions.all[1].to[1] == 190);
  CHECK(motions.all[2].from[0] == 95);
  CHECK(motions.all[2].to[1] == 255);
  CHECK(motions.all[2].line == 3);
  CHECK(motions.all[4].to[0] == 160);
  CHECK(motions.all[4].to[1] == 250);
}

TEST_CASE("sim: canned cycles as motion: pecks and dwells") {
  struct Depths : sim::MotionWatcher {
    void moved(const sim::MachineMotion& motion) override {
      out += fmt::format("{}{:g} ", motion.kind == sim::MotionKind::Rapid ? "r" : "f", motion.to[2]);
    }
    void dwelled(double seconds) override { out += fmt::format("d{:g} ", seconds); }
    std::string out;
  };
  const auto run = [](std::string_view text, std::string_view control = "fanuc-0i-md") {
    Simulation s(control);
    Depths depths;
    s.machine->setWatcher(&depths);
    s.run(text);
    return depths.out + s.state();
  };
  CHECK(run("G81 X0 Z-5. R2. F100") == "r0 r2 f-5 r0 running");
  // Goes back by 1 after a peck; comes up to R and down to 1 above it.
  CHECK(run("G73 Z-5. R2. Q3. F100") == "r2 f-1 r0 f-4 r-3 f-5 r0 running");
  CHECK(run("G83 Z-5. R2. Q3. F100\nG99 X10.") ==
        "r2 f-1 r2 r0 f-4 r2 r-3 f-5 r0 r0 r2 f-1 r2 r0 f-4 r2 r-3 f-5 r2 running");
  CHECK(run("G82 Z-5. R2. P500 F100") == "r2 f-5 d0.5 r0 running");
  CHECK(run("G89 Z-5. R2. P500 F100") == "r2 f-5 d0.5 f2 r0 running");
  CHECK(run("G83 Z-5. R2. F100") == "r2 f-5 r0 running"); // in one go
  // Each mode in the plane of its own.
  CHECK(run("G83 Z-5. R2. Q10. F100\nG80\nG73 Z-5. R2. F100") == "r2 f-5 r0 r2 f-5 r0 running");
}

TEST_CASE("sim: a bare G28 moves where the profile says so") {
  Simulation haas("haas-ngc");
  haas.run("G0 X10. Y20. Z30.\nG91 G28");
  CHECK(haas.machineAt() == "0 0 0");
  CHECK(haas.state() == "running");
  Simulation fanuc;
  fanuc.run("G0 X10. Z4.\nG91 G28");
  CHECK(fanuc.machineAt() == "0 0 0");
  Simulation old("fanuc-6m");
  old.run("G0 X10.\nG91 G28");
  CHECK(old.state() == "inconclusive G");
}

TEST_CASE("sim offset: a profile says that outside corners are arcs") {
  Simulation s;
  for (stdlib::CodeInfo& code : s.profile.codes)
    if (code.function == stdlib::Function::CutterCompLeft) code.title += "; outside corners are arcs";
  s.machine = std::make_unique<sim::Machine>(s.profile);
  REQUIRE(s.machine->preset(13001, 5));
  std::string written;
  sim::Trace trace([&](std::string_view text) { written += text; });
  s.machine->setTrace(&trace);
  s.run("G41 D1 G1 Y10. F100\nY50.\nX50.\nG40 X60.\nM30");
  trace.flush();
  CHECK(written.find("arc-cw xy X0.000000 Y55.000000 Z0.000000 centre 0.000000 50.000000") !=
        std::string::npos);
}
