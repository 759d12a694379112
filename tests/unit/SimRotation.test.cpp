// G68: expectations are computed by hand from the manuals' rule, a point turned counterclockwise about the
// centre.
#include "SimHarness.h"

#include <cmath>
#include <string>
#include <vector>

using namespace dotek;
using tests::Simulation;

namespace {

std::string after(std::string_view text) {
  Simulation s;
  s.run(text);
  return s.state() == "running" ? s.at() : s.state();
}

// Why the run ended as inconclusive.
std::string why(std::string_view text) {
  Simulation s;
  s.run(text);
  return s.machine->end().ending == sim::Ending::Inconclusive ? s.machine->end().text : s.state();
}

bool says(std::string_view text, std::string_view part) {
  const std::string reason = why(text);
  CAPTURE(reason);
  return reason.find(part) != std::string::npos;
}

// A face at X of the machine.
class Face : public sim::SkipSignal {
public:
  explicit Face(double x) : x_(x) {}
  std::optional<double> contact(const sim::SkipMove& move) override {
    const double share = (x_ - move.machineFrom[0]) / (move.machineTo[0] - move.machineFrom[0]);
    if (!(share >= 0 && share <= 1)) return std::nullopt;
    return share;
  }

private:
  double x_;
};

struct Watched : Simulation, sim::MotionWatcher {
  Watched() { machine->setWatcher(this); }
  void moved(const sim::MachineMotion& motion) override { motions.push_back(motion); }
  std::vector<sim::MachineMotion> motions;
};

} // namespace

TEST_CASE("sim: G68 turns absolute moves about its centre") {
  CHECK(after("G68 X0 Y0 R90.\nG0 X10. Y0") == "0 10 0");
  CHECK(after("G68 X10. Y20. R90.\nG0 X15. Y20. Z3.") == "10 25 3");
  CHECK(after("G68 X0 Y0 R-90.\nG1 X10. Y1. F100") == "1 -10 0");
  CHECK(after("G68 X0 Y0 R45.\nG0 X10. Y0") == "7.07107 7.07107 0");
  // One axis of the plane moves both, from where the program is.
  CHECK(after("G68 X0 Y0 R90.\nG0 X10. Y0\nX5.") == "0 5 0");
  CHECK(after("G68 X0 Y0 R90.\nG0 X10. Y2.\nY5.\nZ-1.") == "-5 10 -1");
  // The codes of the block come with it; words of the block are the centre and move nothing.
  CHECK(after("G0 G90 G68 X5. Y5. R30.") == "0 0 0");
  // Another rotation replaces the first.
  CHECK(after("G68 X0 Y0 R90.\nG0 X1. Y1.\nG68 X0 Y0 R180.\nG0 X10. Y0") == "-10 0 0");
}

TEST_CASE("sim: G68 in the other planes turns from their first axis to their second") {
  CHECK(after("G18\nG68 Z0 X0 R90.\nG0 Z10. X0") == "10 0 0");
  CHECK(after("G19\nG68 Y0 Z0 R90.\nG0 Y10. Z0") == "0 0 10");
}

TEST_CASE("sim: incremental moves under G68 turn their way") {
  CHECK(after("G0 X10. Y10.\nG68 X0 Y0 R90.\nG91 X5.") == "10 15 0"); // manual: the tool is the centre
  CHECK(after("G68 X0 Y0 R90.\nG0 X10. Y0\nG91 X5. Y1.") == "-1 15 0");
  CHECK(after("G68 X0 Y0 R90.\nG91 X5.\nG90 X1. Y0") == "0 1 0");
}

TEST_CASE("sim: arcs under G68 turn with their centre") {
  Watched w;
  w.run("G68 X0 Y0 R90.\nG1 X10. Y0 F100\nG3 X0 Y10. I-10. J0");
  CHECK(w.state() == "running");
  CHECK(w.at() == "-10 0 0");
  for (const sim::MachineMotion& motion : w.motions)
    if (motion.to[0] < -1e-9) CHECK(std::hypot(motion.to[0], motion.to[1]) == doctest::Approx(10));
  CHECK(w.motions.size() > 10);
  CHECK(after("G68 X0 Y0 R90.\nG1 X10. Y0 F100\nG3 X0 Y10. R10.") == "-10 0 0");
  CHECK(after("G68 X0 Y0 R37.\nG1 X10. Y0 F100\nG2 X10. Y0 I5. J0") == after("G68 X0 Y0 R37.\nG0 X10. Y0"));
  CHECK(after("G68 X0 Y0 R90.\nG1 X10. Y0 F100\nG3 X0 Y10. I-9. J0") == "alarm 20");
}

TEST_CASE("sim: canned cycles under G68 lie over turned holes") {
  CHECK(after("G0 Z50.\nG68 X0 Y0 R90.\nG99 G81 X10. Y0 Z-5. R2. F100\nX20.") == "0 20 2");
  CHECK(after("G0 Z50.\nG68 X0 Y0 R90.\nG0 X0 Y0\nG91 G99 G81 X10. Y0 Z-5. R-40. K3 F100") == "0 30 10");
}

TEST_CASE("sim: a watcher sees both axes move where one is named") {
  Watched w;
  w.run("G10 L2 P1 X100. Y50.\nG68 X0 Y0 R90.\nG0 X10. Y0\nX20.");
  REQUIRE(w.motions.size() == 2);
  CHECK(w.motions[1].to[0] == 100);
  CHECK(w.motions[1].to[1] == 70);
}

TEST_CASE("sim: G53 and G28 are not turned") {
  Simulation s;
  s.run("G10 L2 P1 X100. Y50.\nG68 X0 Y0 R90.\nG0 X10. Y0\nG53 X5. Y6.");
  CHECK(s.machineAt() == "5 6 0");
  s.run("G91 G28 X0 Y0\nG90");
  CHECK(s.machineAt() == "0 0 0");
  s.run("G0 X10. Y0");
  CHECK(s.machineAt() == "100 60 0");
  s.run("G53 X5.");
  CHECK(s.machineAt() == "5 60 0");
  s.run("X1."); // where Y is in turned coordinates
  CHECK(s.state() == "inconclusive X");
  CHECK(after("G0 Z-5.\nG68 X0 Y0 R30.\nG91 G28 Z0") == "0 0 0");
  CHECK(says("G68 X0 Y0 R30.\nG28 X5. Y5.", "reference return"));
}

TEST_CASE("sim: the first move after G68 names both axes, or the control's file says what the other does") {
  const std::string one = "G0 X10. Y10.\nG68 X0 Y0 R45.\nY14.142";
  CHECK(says(one, "11600#5"));
  CHECK(after("G68 X0 Y0 R45.\nX10.") == "7.07107 7.07107 0"); // from the centre both readings are one
  // The example of the manual, by both settings of the parameter.
  for (const bool turned : {true, false}) {
    Simulation s;
    s.profile.rotation.otherAxis =
        turned ? stdlib::RotationFacts::Position::Turned : stdlib::RotationFacts::Position::AsBefore;
    s.run(one);
    CHECK(std::abs(s.machine->position()[0] - (turned ? 0 : -2.929)) < 1e-3);
    CHECK(std::abs(s.machine->position()[1] - (turned ? 20 : 17.071)) < 1e-3);
  }
}

TEST_CASE("sim: G69 ends the rotation, and an incremental move right after it is refused") {
  const std::string turned = "G68 X0 Y0 R90.\nG0 X10. Y0\nG69\n";
  CHECK(after(turned + "X3.") == "3 10 0");
  CHECK(after("G68 X0 Y0 R90.\nG0 X10. Y0\nG69 G0 X1. Y2.") == "1 2 0");
  CHECK(says(turned + "G91 X1.", "after `G69`"));
  CHECK(after(turned + "G90 X3. Y4.\nG91 X1.") == "4 4 0");
  CHECK(after(turned + "G91 G28 X0 Y0\nX1.") == "1 0 0");
  CHECK(after(turned + "G91 Z-1.") == "0 10 -1");
  CHECK(after("G0 X5.\nG68 X0 Y0 R90.\nG69\nG91 X1.") == "6 0 0"); // nothing moved while it was on
}

TEST_CASE("sim: what the manuals do not allow under G68 ends the run") {
  const std::string on = "G68 X0 Y0 R30.\n";
  CHECK(says(on + "G52 X1.", "local system"));
  CHECK(says(on + "G92 X1.", "G92"));
  CHECK(says(on + "G55", "another work system"));
  CHECK(says(on + "G10 L2 P1 X5.", "another zero"));
  CHECK(says(on + "G18", "another plane"));
  CHECK(after(on + "G17 G54 G90 G10 L2 P2 X5.\nG69 G55 X0") == "0 0 0");
  Simulation s;
  s.run(on);
  CHECK_FALSE(s.machine->write(5221, 3));
  CHECK(s.state() == "inconclusive");
}

TEST_CASE("sim: a rotation that is not complete ends the run") {
  CHECK(says("G68 X0 Y0", "without `R`"));
  CHECK(says("G68 X0 R30.", "Y is missing"));
  CHECK(says("G68 X0 Y0 R400.", "360"));
  CHECK(says("G68 X0 Y0 Z0 R30.", "plane"));
  CHECK(says("G68 X0 Y0 R30.\nG91 G68 X0 Y0 R30.", "5400#0"));
  CHECK(says("G68 X1. Y0 Z0 I0 J0 K1. R30.", "in space"));
  CHECK(says("G68 X0 Y0 Z0 I1. J0 K0 R30.", "in space"));
  CHECK(after("G68 X0 Y0 Z0 I0 J0 K1. R90.\nG0 X10. Y0") == "0 10 0"); // as posts write it
  CHECK(after("G0 X10. Y0\nG68 R90.\nG0 X20. Y0") == "10 10 0");       // about where the tool is
}

TEST_CASE("sim: variables of positions under G68") {
  Simulation s;
  s.run("G10 L2 P1 X100. Y50.\nG68 X0 Y0 R90.\nG0 X10. Y2. Z7.");
  CHECK(s.machine->read(5021) == 98);
  CHECK(s.machine->read(5022) == 60);
  CHECK(s.machine->read(5043) == 7); // not of the plane
  CHECK(s.machine->read(4016) == 68);
  CHECK_FALSE(s.machine->read(5041)); // turned or not: no source
  CHECK(s.state() == "inconclusive");
  for (const bool work : {true, false}) {
    Face face(95);
    Simulation known;
    known.profile.rotation.positions =
        work ? stdlib::RotationFacts::Frame::Work : stdlib::RotationFacts::Frame::Program;
    known.machine->setSkipSignal(&face);
    known.run("G10 L2 P1 X100. Y50.\nG68 X0 Y0 R90.\nG0 X10. Y2.\nG31 Y20. F100");
    CHECK(known.machineAt() == "95 60 0"); // the skip move is turned
    CHECK(known.machine->read(5061) == (work ? -5 : 10));
    CHECK(known.machine->read(5062) == (work ? 10 : 5));
    CHECK(known.machine->read(5041) == (work ? -5 : 10));
    CHECK(known.machine->read(5002) == (work ? 10 : 5));
  }
}

TEST_CASE("sim: a skip position that was latched under G68 is not read as another one after G69") {
  Face face(95);
  Simulation s;
  s.machine->setSkipSignal(&face);
  s.run("G10 L2 P1 X100. Y50.\nG68 X0 Y0 R90.\nG0 X10. Y2.\nG31 Y20. F100\nG69");
  CHECK_FALSE(s.machine->read(5061));
  Simulation before;
  before.machine->setSkipSignal(&face);
  before.run("G10 L2 P1 X100. Y50.\nG0 X0 Y0\nG31 X-20. F100\nG0 X0 Y0");
  CHECK(before.machine->read(5061) == -5);
}
