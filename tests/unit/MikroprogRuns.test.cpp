// Programs for Mikroprog do on a machine what the cycle means: the datum lies on the part, a missing surface
// and an early contact end in their tails.
#include "MikroprogHelper.h"

#include <random>

using namespace dotek;
using namespace dotek::tests;
using sim::MikroprogEnding;
using sim::MikroprogEvent;

namespace {

constexpr double kRadius = 3;

// One surface at `nominal` of its axis, searched from `start` by `travel`.
struct Touch : Maker {
  Touch(ir::Axis axis, double depth, double travel, double nominal) {
    cycle.name = "touch";
    move(ir::Motion::Protected, ir::Axis::Z, number(50));
    add(ir::Spindle{});
    add(ir::Coolant{});
    if (axis != ir::Axis::Z) move(ir::Motion::Protected, ir::Axis::Z, number(5), number(1000));
    move(ir::Motion::Protected, ir::Axis::Z, number(depth), number(200));
    surface(axis, number(travel), number(56), number(nominal));
    add(ir::Store{number(550), ir::result(ir::ResultName::Main)});
    move(ir::Motion::Rapid, ir::Axis::Z, number(50), number(5000));
  }
};

struct Run {
  MikroprogTarget& target;
  MikroprogEmission emission;
  sim::BlockList program;
  sim::MikroprogMachine machine;

  Run(MikroprogTarget& to, const ir::Cycle& cycle, sim::SkipSignal& part)
      : target(to), emission(to.emit(cycle)), program(readBack(emission.text(), to.control)),
        machine(to.control, program) {
    machine.setSkipSignal(&part);
    machine.setPosition({-20, 20, 100});
    machine.run();
    CAPTURE(machine.why());
    CHECK(machine.ending() == MikroprogEnding::ProgramEnd);
  }
  std::size_t count(MikroprogEvent::Kind kind) const {
    return static_cast<std::size_t>(std::count_if(machine.events().begin(), machine.events().end(),
                                                  [&](const MikroprogEvent& e) { return e.kind == kind; }));
  }
};

// Errors of the part that the clearances allow.
std::vector<double> errors() {
  std::vector<double> out = {0, 1.5, -1.5};
  std::mt19937 random(6);
  for (int i = 0; i < 30; ++i)
    out.push_back(static_cast<double>(static_cast<int>(random() % 3001) - 1500) / 1000);
  return out;
}

} // namespace

TEST_CASE("mikroprog: the datum of a surface lies on the part, whatever its error is") {
  for (const ir::Axis axis : ir::kAxes) {
    const std::size_t i = ir::indexOf(axis);
    for (const double nominal : {0.0, 100.0, -12.5})
      for (const double error : errors())
        for (const double side : {1.0, -1.0}) {
          if (axis == ir::Axis::Z && side > 0) continue;
          MikroprogTarget target;
          target.options.hosts["start_x"] = axis == ir::Axis::X ? -10 * side : 10;
          target.options.hosts["start_y"] = axis == ir::Axis::Y ? -10 * side : 10;
          const bool top = axis == ir::Axis::Z;
          const Touch cycle(axis, top ? 10 : -5, 10 * side, nominal);
          Box part;
          part.high[2] = top ? error : 0; // Z counts to the lowest point
          if (!top) (side > 0 ? part.low : part.high)[i] = error - side * kRadius;
          if (top) part.low[2] = -50;
          CAPTURE(error);
          const Run run(target, cycle.cycle, part);
          CHECK(run.machine.lastStop() == "");
          CHECK(run.count(MikroprogEvent::Kind::Record) == 1);
          // The surface, in the coordinates that the program leaves.
          CHECK(error - run.machine.offset()[i] == doctest::Approx(nominal).epsilon(1e-9));
          CHECK(run.machine.position()[2] == doctest::Approx(50 + (top ? nominal : 0)));
        }
  }
}

TEST_CASE("mikroprog: with the tool length to the centre the datum of a top is the same") {
  MikroprogTarget target;
  target.options.lengthToCentre = true;
  const Touch cycle(ir::Axis::Z, 20, -20, 7);
  Box part;
  part.high[2] = 0.25 + kRadius; // the centre is a radius above the surface
  part.low[2] = -50;
  const Run run(target, cycle.cycle, part);
  CHECK(0.25 - run.machine.offset()[2] == doctest::Approx(7));
}

TEST_CASE("mikroprog: a lathe counts X as a diameter") {
  MikroprogTarget target("mikroprog-s280");
  target.options.hosts.erase("start_y");
  target.options.hosts["start_x"] = 30;
  const Touch cycle(ir::Axis::X, -5, -10, 20); // a shaft of diameter 40, from outside
  Box part;
  part.high = {20.125 + kRadius, 1e6, 0};
  part.low[0] = 0;
  const Run run(target, cycle.cycle, part);
  CHECK(run.emission.has("G92 X46"));
  CHECK(run.emission.has("G18 G90 G94"));
  CHECK(20.125 - run.machine.offset()[0] == doctest::Approx(20));
  CHECK(run.emission.codes().contains("radius-as-diameter"));
}

TEST_CASE("mikroprog: a missing surface ends in its tail") {
  for (const ir::Axis axis : ir::kAxes) {
    MikroprogTarget target;
    const Touch cycle(axis, 10, axis == ir::Axis::Z ? -10 : 10, 0);
    Box nothing;
    nothing.low = {500, 500, -500};
    nothing.high[2] = -400;
    const Run run(target, cycle.cycle, nothing);
    CHECK(run.machine.lastStop() == target.control.notFound);
    CHECK(run.count(MikroprogEvent::Kind::Datum) == 0);
    CHECK(run.count(MikroprogEvent::Kind::Record) == 0);
  }
}

TEST_CASE("mikroprog: contact where none is expected ends in its tail") {
  for (const double top : {60.0, 40.0, 4.0, 0.0}) {
    MikroprogTarget target;
    const Touch cycle(ir::Axis::X, -5, 10, 0);
    Box part; // under the start point
    part.high[2] = top;
    part.low[2] = -50;
    const Run run(target, cycle.cycle, part);
    CHECK(run.machine.lastStop() == target.control.collision);
    CHECK(run.count(MikroprogEvent::Kind::Datum) == 0);
    CHECK(run.machine.machinePosition()[2] == doctest::Approx(top));
  }
}

TEST_CASE("mikroprog: a probe that is in contact at the start moves nowhere") {
  MikroprogTarget target;
  const Touch cycle(ir::Axis::X, -5, 10, 0);
  struct : sim::SkipSignal {
    std::optional<double> contact(const sim::SkipMove& move) override {
      return move.machineFrom == move.machineTo ? std::optional(0.0) : std::nullopt;
    }
  } pressed;
  const Run run(target, cycle.cycle, pressed);
  CHECK(run.machine.lastStop() == target.control.collision);
  CHECK(run.count(MikroprogEvent::Kind::NoContact) == 0);
}

TEST_CASE("mikroprog: the operator's way records and stops at the contact, and sets nothing") {
  MikroprogTarget target;
  target.options.datum = backends::mikroprog::Datum::Operator;
  const Touch cycle(ir::Axis::X, -5, 10, 0);
  Box part;
  part.low[0] = 0.5 - kRadius;
  part.high[2] = 0;
  const Run run(target, cycle.cycle, part);
  CHECK(run.count(MikroprogEvent::Kind::Record) == 1);
  CHECK(run.count(MikroprogEvent::Kind::Datum) == 0);
  CHECK(run.machine.lastStop().find("X-3") != std::string::npos);
  CHECK(run.machine.offset()[0] == 0);
}

TEST_CASE("mikroprog: a corner of three faces") {
  Maker maker;
  maker.cycle.name = "corner";
  maker.add(ir::Spindle{});
  maker.add(ir::Coolant{});
  const auto down = [&](double z) { maker.move(ir::Motion::Protected, ir::Axis::Z, number(z)); };
  const auto over = [&](double x, double y) {
    ir::Move move;
    move.motion = ir::Motion::Protected;
    move.axes[0] = ir::Coordinate{number(x), ir::Frame::Work, nullptr};
    move.axes[1] = ir::Coordinate{number(y), ir::Frame::Work, nullptr};
    maker.add(std::move(move));
  };
  const auto up = [&] { maker.move(ir::Motion::Rapid, ir::Axis::Z, number(50)); };
  down(50), down(-5);
  maker.surface(ir::Axis::X, number(10), number(56), number(100));
  up(), over(10, -10), down(-5);
  maker.surface(ir::Axis::Y, number(10), number(56), number(-40));
  up(), over(10, 10), down(10);
  maker.surface(ir::Axis::Z, number(-10), number(56), number(25));
  up();
  for (const double error : errors()) {
    MikroprogTarget target;
    Box part;
    part.low = {error - kRadius, -error - kRadius, -50};
    part.high[2] = error / 2;
    CAPTURE(error);
    const Run run(target, maker.cycle, part);
    CHECK(run.machine.lastStop() == "");
    CHECK(run.count(MikroprogEvent::Kind::Record) == 3);
    CHECK(error - run.machine.offset()[0] == doctest::Approx(100));
    CHECK(-error - run.machine.offset()[1] == doctest::Approx(-40));
    CHECK(error / 2 - run.machine.offset()[2] == doctest::Approx(25));
    CHECK(run.emission.codes().contains("system-corrected"));
  }
}

TEST_CASE("mikroprog: the middle of a bore by comparing, to a micrometre") {
  Maker maker;
  maker.cycle.name = "bore";
  maker.add(ir::Spindle{});
  maker.add(ir::Coolant{});
  maker.move(ir::Motion::Protected, ir::Axis::Z, number(-5));
  ir::Measure bore;
  bore.feature = ir::Feature::Bore;
  bore.setting.emplace();
  bore.setting->system = number(56);
  bore.setting->nominal = {number(30), number(-7.5), nullptr};
  for (const double diameter : {12.0, 30.0, 71.5, 180.0}) {
    bore.diameter = number(diameter);
    maker.cycle.body.resize(3);
    maker.add(bore);
    maker.move(ir::Motion::Rapid, ir::Axis::Z, number(50));
    for (const double error : errors()) {
      MikroprogTarget target;
      target.options.assumed = {7, 10, 13};
      Ring part;
      part.x = -10 + error, part.y = 10 - error / 3, part.reach = diameter / 2 + error / 4 - kRadius;
      CAPTURE(diameter);
      CAPTURE(error);
      const Run run(target, maker.cycle, part);
      CHECK(run.machine.lastStop() == "");
      CHECK(std::abs(part.x - run.machine.offset()[0] - 30) < 0.0015);
      CHECK(std::abs(part.y - run.machine.offset()[1] + 7.5) < 0.0015);
      const auto& events = run.machine.events();
      const auto last = std::find_if(events.rbegin(), events.rend(), [](const MikroprogEvent& e) {
        return e.kind == MikroprogEvent::Kind::Value;
      });
      REQUIRE(last != events.rend());
      CHECK(std::abs(2 * kRadius - 2 * last->value - (diameter + error / 2)) < 0.005);
    }
  }
}

TEST_CASE("mikroprog: the machine refuses what it does not know") {
  const auto control = loadMikroprog("mikroprog-mill");
  const auto ends = [&](const std::string& text, sim::SkipSignal* part = nullptr) {
    const auto program = readBack(text, control);
    sim::MikroprogMachine machine(control, program);
    machine.setSkipSignal(part);
    machine.run(1000);
    return std::pair(machine.ending(), machine.why());
  };
  Box part;
  part.high[2] = -5;
  CHECK(ends("N10 G31 Z-9\nN20 M30\n").first == MikroprogEnding::Inconclusive);
  CHECK(ends("N10 G31 Z-4\nN20 M30\n", &part).first == MikroprogEnding::Fault);
  CHECK(ends("N10 G31 Z-9\nN20 G31 Z-10\nN30 M30\n", &part).first == MikroprogEnding::Inconclusive);
  CHECK(ends("N10 G0 Z-9\nN20 M30\n", &part).first == MikroprogEnding::Crash);
  CHECK(ends("N10 G1 Z-1\nN20 M30\n").first == MikroprogEnding::Fault);
  CHECK(ends("N10 M17\n").first == MikroprogEnding::Fault);
  CHECK(ends("N10 G27 L30\n").first == MikroprogEnding::Fault);
  CHECK(ends("N10 G27 L10\n").first == MikroprogEnding::Endless);
  CHECK(ends("N10 G23 L10 O1\nN20 M30\n").first == MikroprogEnding::Inconclusive);
  CHECK(ends("N10 P90=P1+1\nN20 M30\n").first == MikroprogEnding::Inconclusive);
  CHECK(ends("N10 G98\nN20 M30\n").first == MikroprogEnding::Inconclusive);
  CHECK(ends("N10 G73 Z1\nN20 M30\n").first == MikroprogEnding::Inconclusive);
  CHECK(ends("N10 G0 X1\n").first == MikroprogEnding::Inconclusive);
  CHECK(ends("N10 P1=8\nN20 P90=P1/2-4\nN30 G23 L50 O10\nN40 M17\nN50 M30\n").first ==
        MikroprogEnding::ProgramEnd);
}
