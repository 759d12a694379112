// Programs for Mikroprog do on a machine what the cycle means: the datum lies on the part, a missing surface
// and an early contact end in their tails.
#include "MikroprogHelper.h"

#include <random>

using namespace dotek;
using namespace dotek::tests;
using sim::Ending;

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

struct Run : MikroprogRun {
  MikroprogEmission emission;

  Run(MikroprogTarget& to, const ir::Cycle& cycle, sim::SkipSignal& part) : Run(to.emit(cycle), to, part) {}
  Run(MikroprogEmission emitted, MikroprogTarget& to, sim::SkipSignal& part)
      : MikroprogRun(emitted.text(), to.control), emission(std::move(emitted)) {
    machine.setSkipSignal(&part);
    machine.startAt({-20, 20, 100});
    start();
    CAPTURE(why());
    CHECK(ending() == Ending::ProgramEnd);
  }
  std::size_t places() const { // M25
    return static_cast<std::size_t>(
        std::count_if(records.begin(), records.end(), [](const Record& one) { return !one.isValue; }));
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
          CHECK(run.lastStop() == "");
          CHECK(run.places() == 1);
          // The surface, in the coordinates that the program leaves.
          CHECK(error - run.machine.activeZero()[i] == doctest::Approx(nominal).epsilon(1e-9));
          CHECK(run.machine.position()[2] == doctest::Approx(50 + (top ? nominal : 0)));
        }
  }
}

TEST_CASE("mikroprog: with the tool length to the centre the datum of a top is the same") {
  MikroprogTarget target;
  target.options.lengthToCentre = true;
  const Touch cycle(ir::Axis::Z, 20, -20, -7);
  Box part;
  part.high[2] = 0.25 + kRadius; // the centre is a radius above the surface
  part.low[2] = -50;
  const Run run(target, cycle.cycle, part);
  CHECK(0.25 - run.machine.activeZero()[2] == doctest::Approx(-7));
}

TEST_CASE("mikroprog: a travel that goes on beyond its surface leads back to where it began") {
  const Touch cycle(ir::Axis::X, -5, 20, 0);
  for (const double error : errors()) {
    CAPTURE(error);
    MikroprogTarget target;
    int asked = 0;
    target.options.drawnSurfaces = [&] {
      ++asked;
      return std::vector<backends::mikroprog::DrawnSurface>{
          {ir::Axis::X, true, 9, {6, 25, -5}},  // on another line
          {ir::Axis::X, false, 3, {6, 10, -5}}, // from the other side
          {ir::Axis::X, true, 0, {-3, 10, -5}},
          {ir::Axis::X, true, 40, {37, 10, -5}}}; // farther than the travel
    };
    Box part;
    part.high[2] = 0;
    part.low[0] = error - kRadius;
    const Run run(target, cycle.cycle, part);
    CHECK(asked == 1);
    CHECK(error - run.machine.activeZero()[0] == doctest::Approx(0).epsilon(1e-9));
    CHECK(run.machine.position()[0] == doctest::Approx(-10));
  }
  MikroprogTarget blind;
  CHECK(blind.emit(cycle.cycle).codes().contains("travel-past-nominal"));
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
  CHECK(20.125 - run.machine.activeZero()[0] == doctest::Approx(20));
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
    CHECK(run.lastStop() == target.control.notFound);
    CHECK(run.datums == 0);
    CHECK(run.places() == 0);
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
    CHECK(run.lastStop() == target.control.collision);
    CHECK(run.datums == 0);
    CHECK(run.machine.machinePosition()[2] == doctest::Approx(top));
  }
}

TEST_CASE("mikroprog: where the start is known the tails take the probe up, once the operator goes on") {
  for (const double start : {60.0, 2.0}) {
    MikroprogTarget target;
    target.options.hosts["start_z"] = start;
    const Touch cycle(ir::Axis::X, -5, 10, 0);
    Box nothing;
    nothing.low = {500, 500, -500};
    nothing.high[2] = -400;
    const Run missing(target, cycle.cycle, nothing);
    CHECK(missing.lastStop() == target.control.notFound);
    // The highest that the program goes to is 50.
    CHECK(missing.machine.machinePosition()[2] == doctest::Approx(std::max(start, 50.0)));
    Box part; // under the start point
    part.high[2] = -2;
    part.low[2] = -50;
    const Run blocked(target, cycle.cycle, part);
    CHECK(blocked.lastStop() == target.control.collision);
    CHECK(blocked.machine.machinePosition()[2] == doctest::Approx(std::max(start, 50.0)));
  }
}

TEST_CASE("mikroprog: a known start below the clearance plane goes up before anything moves across") {
  const auto blocks = [](std::optional<double> start) {
    MikroprogTarget target;
    if (start) target.options.hosts["start_z"] = *start;
    const Touch cycle(ir::Axis::X, -5, 10, 0);
    MikroprogEmission out = target.emit(cycle.cycle);
    return out;
  };
  // All is off and contact is asked for, then up to 5, then across.
  const std::vector<std::string> low = blocks(2).blocks();
  REQUIRE(low.size() > 7);
  CHECK(low[1] == "M5");
  CHECK(low[2] == "M9");
  CHECK(low[3] == "G23 L910 O7");
  CHECK(low[4].starts_with("G31 Z5 L"));
  CHECK(low[5] == "G27 L910");
  CHECK(low[6] == "G0 X-10 Y10");
  const std::vector<std::string> high = blocks(60).blocks();
  CHECK(high[3] == "G23 L910 O7");
  CHECK(high[4] == "G0 X-10 Y10");
  CHECK(blocks(60).text().find("BE Z60") != std::string::npos);
  // Not known: the header says where the operator begins.
  CHECK(blocks(std::nullopt).blocks()[1] == "G0 X-10 Y10");
  const std::string text = blocks(std::nullopt).text();
  CHECK(text.find("AT Z5 OR HIGHER") != std::string::npos);
  CHECK(text.find("N905 G27 L990") != std::string::npos);
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
  CHECK(run.lastStop() == target.control.collision);
  CHECK(run.machine.lastSkip() == sim::Machine::Skip::None);
}

TEST_CASE("mikroprog: the operator's way records and stops at the contact, and sets nothing") {
  MikroprogTarget target;
  target.options.datum = backends::mikroprog::Datum::Operator;
  const Touch cycle(ir::Axis::X, -5, 10, 0);
  Box part;
  part.low[0] = 0.5 - kRadius;
  part.high[2] = 0;
  const Run run(target, cycle.cycle, part);
  CHECK(run.places() == 1);
  CHECK(run.datums == 0);
  CHECK(run.lastStop().find("X-3") != std::string::npos);
  CHECK(run.machine.activeZero()[0] == 0);
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
    CHECK(run.lastStop() == "");
    CHECK(run.places() == 3);
    CHECK(error - run.machine.activeZero()[0] == doctest::Approx(100));
    CHECK(-error - run.machine.activeZero()[1] == doctest::Approx(-40));
    CHECK(error / 2 - run.machine.activeZero()[2] == doctest::Approx(25));
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
      CHECK(run.lastStop() == "");
      CHECK(std::abs(part.x - run.machine.activeZero()[0] - 30) < 0.0015);
      CHECK(std::abs(part.y - run.machine.activeZero()[1] + 7.5) < 0.0015);
      const auto last =
          std::find_if(run.records.rbegin(), run.records.rend(), [](const auto& one) { return one.isValue; });
      REQUIRE(last != run.records.rend());
      CHECK(std::abs(2 * kRadius - 2 * last->value - (diameter + error / 2)) < 0.005);
    }
  }
}

TEST_CASE("mikroprog: the machine refuses what it does not know") {
  const auto ends = [&](const std::string& text, sim::SkipSignal* part = nullptr,
                        std::string_view control = "mikroprog-mill") {
    const auto profile = loadMikroprog(control);
    MikroprogRun run(text, profile);
    run.machine.setSkipSignal(part);
    run.limits.simSteps = 10'000;
    run.start();
    return run.ending();
  };
  Box part;
  part.high[2] = -5;
  CHECK(ends("N10 G31 Z-9\nN20 M30\n") == Ending::Inconclusive);
  CHECK(ends("N10 G31 Z-4\nN20 M30\n", &part) == Ending::Alarm);
  CHECK(ends("N10 G31 Z-9\nN20 G31 Z-10\nN30 M30\n", &part) == Ending::Inconclusive);
  CHECK(ends("N10 G1 Z-1\nN20 M30\n") == Ending::Alarm);
  CHECK(ends("N10 G1 Z-1 F20\nN20 M30\n") == Ending::ProgramEnd);
  CHECK(ends("N10 M17\n") == Ending::Alarm);
  CHECK(ends("N10 G27 L30\n") == Ending::Alarm);
  CHECK(ends("N10 G27 L10\n") == Ending::Limit);
  CHECK(ends("N10 M25 @A.SOU\nN20 G27 L10\n") == Ending::Limit);
  CHECK(ends("N10 G26 L10\n") == Ending::Limit); // it calls itself
  CHECK(ends("N10 G26 L30 H2\nN20 M30\nN30 M17\n") == Ending::Inconclusive);
  CHECK(ends("N10 G26 L30 H1\nN20 M30\nN30 M17\n") == Ending::Inconclusive);
  CHECK(ends("N10 G23 L10 O1\nN20 M30\n") == Ending::Inconclusive);
  CHECK(ends("N10 G23 L10 O7\nN20 M30\n") == Ending::Inconclusive);
  CHECK(ends("N10 P90=P1+1\nN20 M30\n") == Ending::Inconclusive);
  CHECK(ends("N10 P90=1/0\nN20 M30\n") == Ending::Inconclusive);
  CHECK(ends("N10 G23 L10 O10\nN20 M30\n") == Ending::Inconclusive); // no P90
  CHECK(ends("N10 M26 @A.SOU\nN20 M30\n") == Ending::Inconclusive);
  CHECK(ends("N10 G0 XP7\nN20 M30\n") == Ending::Inconclusive);
  CHECK(ends("N10 G73 Z1\nN20 M30\n") == Ending::Inconclusive);
  CHECK(ends("N10 G2 X1 Y1 I1 J0 F100\nN20 M30\n") == Ending::Inconclusive); // Q3
  CHECK(ends("N10 M60 H1\nN20 M30\n") == Ending::Inconclusive);
  CHECK(ends("N10 G0 X1\n") == Ending::Inconclusive); // no M30
  CHECK(ends("N10 G91\nN20 G31 Z-9 L30\nN30 M30\n", &part) == Ending::Inconclusive);
  CHECK(ends("N10 G91 G31 Z-9 L30\nN30 M30\n", &part) == Ending::Inconclusive);
  CHECK(ends("N10 G91\nN20 G90 G31 Z-4 L30\nN30 M30\n", &part) == Ending::ProgramEnd);
  CHECK(ends("N10 G91 G0 X1\nN30 M30\n", nullptr, "mikroprog-s280") == Ending::Inconclusive);
  CHECK(ends("N10 G91 G0 Z1\nN30 M30\n", nullptr, "mikroprog-s280") == Ending::ProgramEnd);
  CHECK(ends("N10 G0 Y1\nN30 M30\n", nullptr, "mikroprog-s280") == Ending::Inconclusive);
  CHECK(ends("N10 M25 @A.SOU G0 X1\nN30 M30\n") == Ending::Inconclusive); // which comes first
  CHECK(ends("N10 P1=8\nN20 P90=P1/2-4\nN30 G23 L50 O10\nN40 M17\nN50 M30\n") == Ending::ProgramEnd);
}

TEST_CASE("mikroprog: conditions compare P90 with where the axis is, X of a lathe as a diameter") {
  const auto jumps = [](const std::string& name, double p, std::uint32_t condition) {
    const auto control = loadMikroprog(name);
    MikroprogRun run(fmt::format("N10 G0 X10 Z-4\nN20 P90={}\nN30 G23 L60 O{}\nN40 M0 ;NE\nN50 M30\nN60 M0 "
                                 ";ANO\nN70 M30\n",
                                 p, condition),
                     control);
    run.start();
    REQUIRE(run.ending() == Ending::ProgramEnd);
    return run.lastStop() == "ANO";
  };
  for (const char* name : {"mikroprog-mill", "mikroprog-s280"}) {
    CHECK(jumps(name, 10, 11)); // P90 at most X
    CHECK_FALSE(jumps(name, 10.001, 11));
    CHECK_FALSE(jumps(name, 10, 12)); // above it
    CHECK(jumps(name, 10.001, 12));
    CHECK(jumps(name, -4, 15));
    CHECK(jumps(name, -3.999, 16));
    CHECK(jumps(name, 0, 10));
    CHECK_FALSE(jumps(name, 1, 10));
  }
}

TEST_CASE("mikroprog: the short form, parameters in words and a subprogram within one") {
  const auto control = loadMikroprog("mikroprog-mill");
  MikroprogRun run("N10 G0 X1\nN20 Y2\nN30 P6=50\nN40 G1 Z-1 FP6\nN50 P2=3\nN60 X-P2\nN70 G26 L100\nN80 M30\n"
                   "N100 G91\nN110 G26 L200\nN120 G90\nN130 M17\nN200 Y10\nN210 M17\n",
                   control);
  run.start();
  CHECK(run.ending() == Ending::ProgramEnd);
  CHECK(run.machine.position()[0] == -3);
  CHECK(run.machine.position()[1] == 12);
  CHECK(run.machine.position()[2] == -1);
  CHECK(run.machine.feed() == 50);
}

TEST_CASE("mikroprog: a G31 is told by where it leads, not by a text") {
  const auto control = loadMikroprog("mikroprog-mill");
  SourceMap sources;
  const ir::Program program =
      readBack("N10 G31 Z5 L30\nN20 G27 L80\nN30 G31 X5 L70\nN40 G31 Y5 L50\nN50 G31 Y9\nN60 M30\n"
               ";none\nN70 G27 L75\nN75 M0 ;EMPTY\nN76 M30\nN80 M0\nN90 M30\n",
               control, sources);
  std::vector<sim::mikroprog::SkipUse> uses;
  for (const auto& one : sim::mikroprog::skipMoves(program, control))
    uses.push_back(one.use);
  using enum sim::mikroprog::SkipUse;
  CHECK(uses == std::vector{Protected, Search, Neither, Blind});
}
