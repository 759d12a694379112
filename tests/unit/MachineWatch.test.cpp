// What a watcher is reported of the machine: every motion in coordinates of the machine, and nothing where
// nothing moves.
#include "tests/unit/SimHarness.h"

#include <cmath>
#include <string>
#include <vector>

using namespace dotek;
using namespace dotek::tests;
using sim::MachineMotion;
using sim::MotionKind;

namespace {

struct Watched : Simulation, sim::MotionWatcher {
  explicit Watched(std::string_view control = "fanuc-0i-md") : Simulation(control) {
    machine->setWatcher(this);
  }
  void moved(const MachineMotion& motion) override {
    motions.push_back(motion);
    if (motion.from != place) chained = false;
    place = motion.to;
  }
  void probeSwitched(bool on) override { switched.push_back(on); }

  // "rapid 1 2 3; feed 1 2 0 ?": where each motion ends; ? where that is not certain.
  std::string told(std::string_view text) {
    motions.clear();
    CAPTURE(text);
    CHECK(run(text));
    CHECK(chained);
    std::string out;
    for (const MachineMotion& motion : motions) {
      static constexpr std::string_view kNames[] = {"rapid", "feed", "skip"};
      out +=
          fmt::format("{}{} {:g} {:g} {:g}{}", out.empty() ? "" : "; ", kNames[static_cast<int>(motion.kind)],
                      motion.to[0] + 0.0, motion.to[1] + 0.0, motion.to[2] + 0.0, motion.known ? "" : " ?");
    }
    return out;
  }

  std::vector<MachineMotion> motions;
  std::vector<bool> switched;
  sim::Position place{};
  bool chained = true; // each motion begins where the one before ended
};

// How far chords lie off the circle about (x, y), at their ends and in their middles.
std::pair<double, double> offCircle(const std::vector<MachineMotion>& motions, double x, double y, double r) {
  double ends = 0, middles = 0;
  for (const MachineMotion& m : motions) {
    ends = std::max(ends, std::abs(std::hypot(m.to[0] - x, m.to[1] - y) - r));
    const double mx = (m.from[0] + m.to[0]) / 2 - x, my = (m.from[1] + m.to[1]) / 2 - y;
    middles = std::max(middles, std::abs(std::hypot(mx, my) - r));
  }
  return {ends, middles};
}

} // namespace

TEST_CASE("watch: straight moves in coordinates of the machine") {
  Watched w;
  CHECK(w.told("G10 L2 P1 X100. Y50. Z-200.\nG10 L10 P1 R80.\nG54\nG52 X1.\nG52 X0.\nG92 X0.\nG92 X-100.\n")
            .empty());
  CHECK(w.told("G0 X10. Y20.") == "rapid 110 70 0");
  // The tool's length moves nothing by itself.
  CHECK(w.told("G43 H1\nG49\n").empty());
  CHECK(w.told("G43 H1 Z30.") == "rapid 110 70 -90");
  CHECK(w.told("G1 X11. F100") == "feed 111 70 -90");
  CHECK(w.told("G91 Z-1.\nG90") == "feed 111 70 -91");
  CHECK(w.told("G55\nG54\nG21\nM3 S100\nG4 P5\n").empty());
}

TEST_CASE("watch: a tool length without Z leaves the machine where it is known to appear") {
  Watched w;
  w.told("G10 L10 P1 R80.\nG0 X1. Y1. Z-100.");
  // The control's coordinates are uncertain, the machine's are not.
  CHECK(w.told("G43 H1\nX5.") == "rapid 5 1 -100");
  CHECK(w.machine->uncertain() != 0);
  CHECK(w.told("Z-150.") == "rapid 5 1 -70");
  CHECK(w.told("G91 G28 Z0\nG49\nG90 X9.\nG43 H1 Z-150.") == "rapid 5 1 0; rapid 9 1 0; rapid 9 1 -70");
}

TEST_CASE("watch: a Z after a reference return under G43 is uncertain until the length is given anew") {
  Watched w;
  w.told("G10 L10 P1 R80.\nG43 H1 Z-150.");
  CHECK(w.told("G28 Z-140.") == "rapid 0 0 -60; rapid 0 0 0");
  CHECK(w.told("G0 Z-150.") == "rapid 0 0 -70 ?");
  CHECK(w.told("X1.") == "rapid 1 0 -70 ?");
  CHECK(w.told("G43 H1 Z-150.") == "rapid 1 0 -70 ?"); // from where is not known
  CHECK(w.told("X2.") == "rapid 2 0 -70");
  CHECK(w.told("G53 Z-20.") == "rapid 2 0 -20");
  CHECK(w.told("Z-150.") == "rapid 2 0 -70 ?");
}

TEST_CASE("watch: reference returns go through their point") {
  Watched w;
  w.told("G10 L2 P1 X-100. Y-50. Z-200.\nG0 X10. Y20. Z30.");
  CHECK(w.told("G28 X15. Y25.") == "rapid -85 -25 -170; rapid 0 0 -170");
  CHECK(w.told("G91 G28 Z10.\nG90") == "rapid 0 0 -160; rapid 0 0 0");
  CHECK(w.told("G0 X0 Y0 Z0\nG91 G28 X0 Y0 Z0\nG90") == "rapid -100 -50 -200; rapid 0 0 0");
  // Where the second point lies is a setting of the machine.
  CHECK(w.told("G91 G30 Z-5.\nG90") == "rapid 0 0 -5; rapid 0 0 0 ?");
  CHECK(w.told("G0 X0") == "rapid -100 0 0 ?");
  CHECK(w.told("Z0") == "rapid -100 0 -200 ?");
  CHECK(w.told("X1.") == "rapid -99 0 -200");
}

TEST_CASE("watch: machine coordinates") {
  Watched w;
  w.told("G10 L2 P1 X-100. Y-50. Z-200.");
  CHECK(w.told("G53 X-10. Y-20.") == "rapid -10 -20 0");
  CHECK(w.told("G1 F50 G53 Z-5.") == "feed -10 -20 -5");
  CHECK(w.told("G53").empty());
}

TEST_CASE("watch: arcs are chords within five micrometres") {
  for (const double radius : {0.004, 0.5, 12.5, 400.0}) {
    for (const bool left : {false, true}) {
      CAPTURE(radius);
      Watched w("fanuc-31i-b");
      w.told("G10 L2 P1 X100. Y50.\nG0 X0 Y0\n");
      // A full circle about (-r, 0), then half a one by R.
      w.told(fmt::format("G{} I-{:g} F100", left ? 3 : 2, radius));
      CHECK(w.place == w.machine->machinePosition());
      const auto [ends, middles] = offCircle(w.motions, 100 - radius, 50, radius);
      CHECK(ends < 1e-9);
      CHECK(middles < 0.005 + 1e-9);
      CHECK(w.motions.size() >= 8);
      // The way it turns: the first chord goes up for one to the left.
      CHECK((w.motions.front().to[1] > 50) == left);
      w.told(fmt::format("G{} X-{:g} Y0 R{:g}", left ? 3 : 2, 2 * radius, radius));
      const auto [ends2, middles2] = offCircle(w.motions, 100 - radius, 50, radius);
      CHECK(ends2 < 1e-6);
      CHECK(middles2 < 0.005 + 1e-6);
      CHECK(w.place == w.machine->machinePosition());
      for (const MachineMotion& motion : w.motions)
        CHECK((motion.kind == MotionKind::Feed && motion.known));
    }
  }
}

TEST_CASE("watch: a helix and an arc of another plane") {
  Watched w;
  w.told("G0 X10. Y0 Z0");
  w.told("G17 G3 X-10. Y0 Z-6. I-10. F100");
  REQUIRE(w.motions.size() > 10);
  for (const MachineMotion& m : w.motions) { // Z goes with the angle
    const double angle = std::atan2(m.to[1], m.to[0]);
    const double turned = angle < -1e-9 ? angle + 2 * M_PI : angle;
    CHECK(m.to[2] == doctest::Approx(-6 * turned / M_PI));
  }
  w.told("G18 G2 X-10. Z-16. K-5.");
  for (const MachineMotion& m : w.motions) {
    CHECK(std::hypot(m.to[0] + 10, m.to[2] + 11) == doctest::Approx(5));
    CHECK(m.to[1] == 0);
  }
  // G2 of the plane ZX turns from Z to X: from the top toward -X or +X as the axes of the plane say.
  CHECK(w.motions.front().to[0] < -10);
  CHECK(w.place == w.machine->machinePosition());
}

TEST_CASE("watch: canned cycles go to R, to the bottom and back") {
  Watched w;
  w.told("G10 L2 P1 Z-100.\nG0 X0 Y0 Z50.");
  CHECK(w.told("G98 G81 X10. Y5. Z-4. R2. F100") ==
        "rapid 10 5 -50; rapid 10 5 -98; feed 10 5 -104; rapid 10 5 -50");
  CHECK(w.told("G99 X20.") == "rapid 20 5 -50; rapid 20 5 -98; feed 20 5 -104; rapid 20 5 -98");
  CHECK(w.told("G85 X30.") == "rapid 30 5 -98; rapid 30 5 -98; feed 30 5 -104; feed 30 5 -98");
  CHECK(w.told("G80\nG0 Z50.") == "rapid 30 5 -50");
  // In incremental mode each repeat is a step further.
  CHECK(w.told("G91 G98 G81 X5. Z-6. R-48. K2") ==
        "rapid 35 5 -50; rapid 35 5 -98; feed 35 5 -104; rapid 35 5 -50; "
        "rapid 40 5 -50; rapid 40 5 -98; feed 40 5 -104; rapid 40 5 -50");
  // Each peck of Q is a way to R and back, down to 1 mm above what is drilled.
  CHECK(w.told("G83 X5. Z-6. R-48. Q3.") ==
        "rapid 45 5 -50; rapid 45 5 -98; feed 45 5 -101; rapid 45 5 -98; rapid 45 5 -100; feed 45 5 -104; "
        "rapid 45 5 -50");
}

TEST_CASE("watch: the path of back boring is not known, its end is") {
  Watched w("fanuc-31i-b");
  w.told("G0 X0 Y0 Z50.");
  CHECK(w.told("G98 G87 X10. Z-4. R-20. Q1. F100") == "rapid 10 0 50; feed 10 0 50 ?");
  CHECK(w.told("G80\nG0 X1.") == "rapid 1 0 50");
}

TEST_CASE("watch: skip moves end where the machine stopped") {
  Watched w;
  struct : sim::SkipSignal {
    std::optional<double> contact(const sim::SkipMove&) override { return 0.25; }
  } quarter;
  w.machine->setSkipSignal(&quarter);
  w.told("G10 L2 P1 X100.\nG0 X0");
  CHECK(w.told("G31 X8. F50") == "skip 102 0 0");
  CHECK(w.told("G91 G31 X8. Y4.\nG90") == "skip 104 1 0");
}

TEST_CASE("watch: the run begins where the machine is") {
  Watched w;
  w.machine->preset(5221, -10);
  sim::Position start{};
  start[0] = -50;
  start[2] = -5;
  w.machine->startAt(start);
  w.place = start;
  CHECK(w.at() == "-40 0 -5");
  CHECK(w.told("G0 Y3.") == "rapid -50 3 -5");
}

TEST_CASE("watch: who watches may end the run") {
  struct Stops : sim::MotionWatcher {
    sim::Machine* machine = nullptr;
    int moves = 0;
    void moved(const MachineMotion&) override {
      if (++moves == 3) machine->inconclusive("enough");
    }
  };
  for (const std::string_view last :
       {"G0 X3.\n", "G2 X0 Y0 I-1. F100\n", "G28 X5. Y5.\n", "G81 X9. Z-4. R2. F100\n"}) {
    CAPTURE(last);
    Simulation s;
    Stops stops;
    stops.machine = s.machine.get();
    s.machine->setWatcher(&stops);
    CHECK(s.run("G0 X1.\nX2.\n"));
    CHECK(!s.run(last));
    CHECK(s.state() == "inconclusive");
    CHECK(s.machine->end().text == "enough");
    CHECK(stops.moves == 3);
    CHECK(!s.run("G0 X4.\n"));
    CHECK(stops.moves == 3);
  }
}

TEST_CASE("watch: a watched run has the same trace") {
  constexpr std::string_view kText =
      "G10 L2 P1 X100.\nG10 L10 P1 R5.\nG0 X1.5 Y2.\nG43 H1 Z10.\nG1 Z-1. F100\n"
      "G2 X3. Y2. I0.75\nG81 X5. Z-3. R1.\nG80\nG28 X0\nG0 X1. Y1.\nM30\n";
  std::string traces[2];
  for (const bool watched : {false, true}) {
    Simulation s;
    struct : sim::MotionWatcher {
      void moved(const MachineMotion&) override {}
    } nobody;
    if (watched) s.machine->setWatcher(&nobody);
    sim::Trace trace([&](std::string_view piece) { traces[watched] += piece; });
    s.machine->setTrace(&trace);
    s.run(kText);
    s.machine->setTrace(nullptr);
    trace.flush();
  }
  CHECK(traces[0] == traces[1]);
  CHECK(traces[0].size() > 400);
}
