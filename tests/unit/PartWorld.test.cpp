// The probe in its machine: every outcome, and what a cycle measures.
#include "sim/machine/World.h"

#include "tests/unit/PartHelper.h"

#include <doctest/doctest.h>
#include <set>

using namespace dotek;
using namespace dotek::sim;
using namespace dotek::tests;
using Action = PartBuilder::Action;

namespace {

Part plate() {
  PartBuilder builder;
  builder.box({0, 0, -20}, {100, 60, 0});
  builder.cylinder({50, 30, -20}, {50, 30, 0}, 19, Action::Remove);
  return *finish(builder);
}

Probe probe() {
  Probe out;
  out.ballDiameter = 6;
  out.effectiveRadius = 3;
  out.length = 100;
  out.stemDiameter = 4;
  out.stemLength = 30;
  out.bodyDiameter = 30;
  out.bodyLength = 40;
  out.overtravel = 5;
  return out;
}

// Moves given by the ball's centre.
struct Bench {
  World world;
  explicit Bench(const Probe& p, const Part& part = plate(), const MachineLimits& limits = {})
      : world(part, p, limits) {}

  Position at(const Point3& c) const { return {c.x, c.y, c.z + world.probe().centreLength()}; }
  std::optional<double> skip(const Point3& from, const Point3& to) {
    SkipMove move;
    move.machineFrom = at(from);
    move.machineTo = at(to);
    return world.contact(move);
  }
  void move(MotionKind kind, const Point3& from, const Point3& to) {
    world.moved({kind, at(from), at(to), 7});
  }
  std::vector<Outcome> outcomes() const {
    std::vector<Outcome> out;
    for (const ProbeEvent& event : world.events())
      out.push_back(event.outcome);
    return out;
  }
  // Where the ball's centre stops.
  Point3 stop(const Point3& from, const Point3& to) {
    const auto share = skip(from, to);
    REQUIRE(share);
    return from + (to - from) * *share;
  }
};

using Outcomes = std::vector<Outcome>;

} // namespace

TEST_CASE("probe: the length is to the tip or to the centre") {
  Probe p = probe();
  SkipMove move;
  move.machineFrom = {10, 10, 150};
  move.machineTo = {10, 10, 90};
  CHECK(*World(plate(), p).contact(move) * 60 == doctest::Approx(50)); // the tip is 100 below
  p.lengthToTip = false;
  CHECK(*World(plate(), p).contact(move) * 60 == doctest::Approx(47)); // the centre does
}

TEST_CASE("probe: contact, miss, early contact") {
  Bench bench(probe());
  CHECK(*bench.skip({-23, 30, -5}, {-3, 30, -5}) == doctest::Approx(1)); // exactly at the end
  CHECK(*bench.skip({-23, 30, -5}, {17, 30, -5}) == doctest::Approx(0.5));
  CHECK(!bench.skip({-23, 30, -5}, {-3.1, 30, -5}));
  CHECK(*bench.skip({-2.5, 30, -5}, {5, 30, -5}) == 0);
  CHECK(!bench.skip({-2.5, 30, -5}, {-9, 30, -5})); // away
  CHECK(bench.outcomes() ==
        Outcomes{Outcome::Contact, Outcome::Contact, Outcome::Miss, Outcome::EarlyContact, Outcome::Miss});
  const ProbeEvent& contact = bench.world.events()[1];
  CHECK(lengthOf(contact.point - Point3{0, 30, -5}) < 1e-8);
  CHECK(lengthOf(contact.centre - Point3{-3, 30, -5}) < 1e-8);
  CHECK(contact.depth == doctest::Approx(0));
}

TEST_CASE("probe: the signal comes later than the touch") {
  Probe p = probe();
  p.effectiveRadius = 2.98;
  p.preTravel = 0.01;
  Bench bench(p);
  CHECK(bench.stop({-23, 30, -5}, {17, 30, -5}).x == doctest::Approx(-2.97));
  // The path ends after the touch and before the signal.
  CHECK(!bench.skip({-23, 30, -5}, {-2.975, 30, -5}));
  CHECK(bench.outcomes() == Outcomes{Outcome::Contact, Outcome::NoSignal});
  CHECK(bench.world.events()[1].depth == doctest::Approx(0.025));
  // Back, and slowly again: a touch of its own.
  bench.move(MotionKind::Rapid, {-2.97, 30, -5}, {-4, 30, -5});
  CHECK(bench.world.events().size() == 2);
}

TEST_CASE("probe: noise is bounded, bell-shaped and the same again") {
  Probe p = probe();
  p.noise = 0.0005;
  p.seed = 42;
  Bench bench(p), same(p);
  p.seed = 43;
  Bench other(p);
  double sum = 0, squares = 0;
  int within = 0, differs = 0;
  constexpr int kTouches = 2000;
  for (int n = 0; n < kTouches; ++n) {
    const double x = bench.stop({-23, 30, -5}, {17, 30, -5}).x + 3;
    CHECK(same.stop({-23, 30, -5}, {17, 30, -5}).x + 3 == x);
    differs += other.stop({-23, 30, -5}, {17, 30, -5}).x + 3 != x ? 1 : 0;
    CHECK(std::abs(x) <= 3 * p.noise + 1e-9);
    sum += x;
    squares += x * x;
    within += std::abs(x) <= p.noise ? 1 : 0;
  }
  CHECK(differs > kTouches / 2);
  CHECK(within > kTouches * 0.65); // 0.68 of a bell lie within one deviation
  CHECK(within < kTouches * 0.72);
  CHECK(std::abs(sum / kTouches) < p.noise * 0.1);
  CHECK(std::sqrt(squares / kTouches) == doctest::Approx(p.noise).epsilon(0.05));
  bench.world.restart(42);
  same.world.restart(42);
  CHECK(bench.stop({-23, 30, -5}, {17, 30, -5}).x == same.stop({-23, 30, -5}, {17, 30, -5}).x);
}

TEST_CASE("probe: off, it sees nothing and the machine goes on") {
  Probe p = probe();
  p.on = false;
  Bench bench(p);
  CHECK(!bench.skip({-23, 30, -5}, {-1, 30, -5}));
  bench.world.setOn(true);
  CHECK(bench.skip({-23, 30, -5}, {-1, 30, -5}));
  bench.world.setOn(false);
  bench.move(MotionKind::Feed, {-23, 30, -5}, {-1, 30, -5});
  CHECK(bench.outcomes() == Outcomes{Outcome::NotArmed, Outcome::Contact, Outcome::NotArmed});
  CHECK(bench.world.events()[0].depth == doctest::Approx(2));
}

TEST_CASE("probe: stem and body collide") {
  // A roof over the face that is touched: the stem meets it first.
  PartBuilder builder;
  builder.box({0, 0, -20}, {100, 60, 0});
  builder.box({-10, 0, 5}, {100, 60, 10});
  builder.box({-90, 0, 45}, {-60, 60, 50});
  const Part roof = *finish(builder);
  Bench bench(probe(), roof);
  const auto share = bench.skip({-30, 30, -5}, {10, 30, -5});
  REQUIRE(share); // a bent stem signals
  CHECK(*share * 40 == doctest::Approx(30 - 10 - 2).epsilon(1e-3));
  bench.move(MotionKind::Rapid, {-40, 30, -5}, {-60, 30, -5});
  CHECK(bench.outcomes() == Outcomes{Outcome::StemCollision, Outcome::BodyCollision});
  CHECK(bench.world.events()[1].share < 0.5);
  // Far enough away nothing happens.
  bench.move(MotionKind::Rapid, {-40, 30, -5}, {-40, 50, -5});
  CHECK(bench.world.events().size() == 2);
}

TEST_CASE("probe: rapids and feeds into the part, and through it") {
  Bench bench(probe());
  bench.move(MotionKind::Rapid, {-23, 30, -5}, {-2, 30, -5});
  bench.move(MotionKind::Feed, {-23, 30, -5}, {-2, 30, -5});
  bench.move(MotionKind::Feed, {-23, 30, -5}, {10, 30, -5});
  bench.move(MotionKind::Rapid, {-23, 30, -5}, {-2, 90, -5});
  bench.move(MotionKind::Skip, {-23, 30, -5}, {10, 30, -5}); // looked at by contact()
  bench.move(MotionKind::Rapid, {-23, 30, 5}, {150, 30, 5});
  CHECK(bench.outcomes() == Outcomes{Outcome::RapidIntoPart, Outcome::EarlyContact, Outcome::Overtravel});
  CHECK(bench.world.events()[0].line == 7);
  CHECK(bench.world.events()[2].depth == doctest::Approx(13));
}

TEST_CASE("probe: travel and other axes") {
  MachineLimits limits;
  limits.travel[0] = MachineLimits::Span{-50, 80};
  Bench bench(probe(), plate(), limits);
  bench.move(MotionKind::Rapid, {0, 0, 50}, {160, 0, 50});
  bench.move(MotionKind::Rapid, {160, 0, 50}, {0, 0, 50}); // back in
  CHECK(bench.outcomes() == Outcomes{Outcome::OutsideTravel});
  CHECK(bench.world.events()[0].share == doctest::Approx(0.5));
  SkipMove move;
  move.machineFrom = bench.at({-23, 30, -5});
  move.machineTo = bench.at({17, 30, -5});
  move.machineTo[3] = 90; // A
  CHECK(!bench.world.contact(move));
  CHECK(bench.world.events().back().outcome == Outcome::NotModelled);
  // A touch before the end of the travel is a touch.
  CHECK(bench.skip({-23, 30, -5}, {97, 30, -5}));
  CHECK(bench.world.events().back().outcome == Outcome::Contact);
}

TEST_CASE("probe: a cycle measures the part where it lies, to a micrometre") {
  PartRandom random(77);
  for (int n = 0; n < 40; ++n) {
    const Placement error{random.point(0.5), {0, 0, random.between(-2, 2)}};
    const Placement nominal{random.point(200), {0, 0, 90.0 * random.below(4)}};
    const Part part = plate().placed(nominal, error);
    Bench bench(probe(), part);
    const Point3 centre = part.toMachine({50, 30, -8});
    // Bore: from a place beside the middle, along X, then along Y from the middle of the chord.
    const Point3 start = centre + Point3{random.between(-1, 1), random.between(-1, 1), 0};
    const double right = bench.stop(start, start + Point3{40, 0, 0}).x;
    const double left = bench.stop(start, start + Point3{-40, 0, 0}).x;
    const Point3 middle{(left + right) / 2, start.y, start.z};
    const double back = bench.stop(middle, middle + Point3{0, 40, 0}).y;
    const double front = bench.stop(middle, middle + Point3{0, -40, 0}).y;
    CHECK(std::abs((left + right) / 2 - centre.x) < 1e-6);
    CHECK(std::abs((back + front) / 2 - centre.y) < 1e-6);
    CHECK(std::abs(back - front - 2 * 16) < 1e-6);
    // The angle of a face, from two touches square to it as it is meant to be.
    const auto meant = plate().placed(nominal);
    const auto onFace = [&](double y) {
      return bench.stop(meant.toMachine({-20, y, -8}) + error.shift,
                        meant.toMachine({20, y, -8}) + error.shift);
    };
    const Point3 a = onFace(15), b = onFace(45);
    const Point3 side = meant.turnToMachine({0, 1, 0}), out = meant.turnToMachine({-1, 0, 0});
    const double angle = std::atan2((b - a).dot(out), (b - a).dot(side)) * 180 / M_PI;
    CHECK(std::abs(angle - error.turn.z) < 1e-5);
    // And the upper face.
    const Point3 top = part.toMachine({15, 45, 20});
    CHECK(std::abs(bench.stop(top, top - Point3{0, 0, 30}).z - 3 - nominal.shift.z - error.shift.z) < 1e-6);
    for (const Outcome outcome : bench.outcomes())
      CHECK(outcome == Outcome::Contact);
  }
}

TEST_CASE("probe: every trouble has its message") {
  const std::vector<std::pair<Outcome, std::string>> expected = {
      {Outcome::EarlyContact, "early-contact"},   {Outcome::Miss, "probe-miss"},
      {Outcome::NotArmed, "probe-not-armed"},     {Outcome::NoSignal, "no-probe-signal"},
      {Outcome::Overtravel, "probe-overtravel"},  {Outcome::StemCollision, "stem-collision"},
      {Outcome::BodyCollision, "body-collision"}, {Outcome::RapidIntoPart, "rapid-into-part"},
      {Outcome::StartInside, "start-inside"},     {Outcome::OutsideTravel, "outside-travel"},
      {Outcome::NotModelled, "axis-not-modelled"}};
  for (const auto& [outcome, code] : expected) {
    Diagnostics diagnostics;
    ProbeEvent event;
    event.outcome = outcome;
    event.centre = {1, -2.5, 3};
    event.axis = 2;
    event.reached = 50;
    event.limit = 10;
    reportEvent(event, {}, diagnostics);
    REQUIRE(diagnostics.all().size() == 1);
    CHECK(diagnostics.all()[0].code == code);
    CHECK((diagnostics.all()[0].severity == Severity::Error) == (outcome != Outcome::Miss));
    if (outcome == Outcome::OutsideTravel)
      CHECK(
          diagnostics.all()[0].message.find("Z+ over-travel: the move takes the spindle to machine Z50.000, "
                                            "and the travel ends at Z10.000") != std::string::npos);
    else if (outcome != Outcome::NotModelled)
      CHECK(diagnostics.all()[0].message.find("X1.000 Y-2.500 Z3.000") != std::string::npos);
  }
  Diagnostics none;
  ProbeEvent contact;
  contact.outcome = Outcome::Contact;
  reportEvent(contact, {}, none);
  CHECK(none.empty());
}

TEST_CASE("probe: without a part nothing is touched, and the travel is looked at") {
  MachineLimits limits;
  limits.travel[0] = MachineLimits::Span{-10, 10};
  World world(Part(), probe(), limits);
  SkipMove move;
  move.machineTo[2] = -500;
  CHECK(!world.contact(move));
  CHECK(!world.isThere(move));
  Position far{};
  far[0] = 11;
  far[4] = 30; // a rotary axis turns no part
  world.moved({MotionKind::Rapid, {}, far, 3, true});
  REQUIRE(world.events().size() == 2);
  CHECK(world.events()[0].outcome == Outcome::Miss);
  CHECK(world.events()[1].outcome == Outcome::OutsideTravel);
  CHECK(world.events()[1].line == 3);
}

TEST_CASE("probe: a motion whose place is not known says nothing of the part") {
  Bench bench(probe());
  bench.world.moved({MotionKind::Rapid, bench.at({50, 30, 20}), bench.at({50, 5, -5}), 7, false});
  REQUIRE(bench.world.events().size() == 1);
  CHECK(bench.world.events()[0].outcome == Outcome::NotModelled);
  Diagnostics diagnostics;
  reportEvent(bench.world.events()[0], {}, diagnostics);
  CHECK(diagnostics.all().front().code == "place-not-known");
  bench.world.forgetEvents();
  CHECK(bench.world.events().empty());
}

TEST_CASE("probe: standing, it is deflected where a touch has stopped it") {
  Probe noisy = probe();
  noisy.noise = 0.001;
  noisy.preTravel = 0.01;
  noisy.effectiveRadius = 2.98;
  for (std::uint64_t seed = 1; seed < 200; ++seed) {
    noisy.seed = seed;
    Bench bench(noisy);
    const Point3 stop = bench.stop({-20, 30, -10}, {5, 30, -10});
    SkipMove here;
    here.machineFrom = here.machineTo = bench.at(stop);
    bench.world.forgetEvents();
    CHECK(bench.world.isThere(here));
    here.machineFrom[0] -= 0.05;
    CHECK(!bench.world.isThere(here));
    here.machineFrom = here.machineTo;
    bench.world.probeSwitched(false);
    CHECK(!bench.world.isThere(here));
    CHECK(bench.world.events().empty());
  }
}

TEST_CASE("probe: backing off from a collision is no second one") {
  Bench bench(probe());
  bench.move(MotionKind::Rapid, {80, 20, 20}, {80, 20, 1.5}); // the stem's round end reaches the face, too
  bench.move(MotionKind::Rapid, {80, 20, 1.5}, {80, 20, 20});
  CHECK(bench.outcomes() == std::vector{Outcome::RapidIntoPart});
  bench.move(MotionKind::Rapid, {80, 20, 20}, {80, 20, 1.5});
  CHECK(bench.outcomes().size() == 2);
  bench.world.restart(1);
  // What is there at the start was reported by nobody.
  bench.move(MotionKind::Rapid, {80, 20, 1.5}, {80, 20, 20});
  CHECK(bench.outcomes() == std::vector{Outcome::StartInside});
}

TEST_CASE("probe: a path that is asked for again meets the part that is there now") {
  Bench bench(probe());
  const Point3 from{-20, 30, -10}, to{20, 30, -10};
  const auto first = bench.skip(from, to);
  REQUIRE(first);
  CHECK(bench.skip(from, to) == first);
  CHECK(bench.outcomes() == std::vector{Outcome::Contact, Outcome::Contact});
  bench.move(MotionKind::Feed, {80, 20, 20}, {80, 20, 1.5});
  bench.world.setPart(plate().placed({{5, 0, -40}, {}}));
  bench.world.restart(1);
  CHECK(!bench.skip(from, to));
  bench.move(MotionKind::Feed, {80, 20, 20}, {80, 20, 1.5});
  CHECK(bench.outcomes() == std::vector{Outcome::Miss});
}

TEST_CASE("probe: a run that begins in the part says that, and no more of its first motion's start") {
  const auto message = [](const ProbeEvent& event) {
    Diagnostics out;
    reportEvent(event, {}, out);
    return out.all().empty() ? std::string() : out.all().front().message;
  };
  for (const MotionKind kind : {MotionKind::Rapid, MotionKind::Feed, MotionKind::Skip}) {
    for (const Point3& to : {Point3{40, 10, -10}, Point3{10, 10, 30}}) { // deeper, and out of it
      Bench bench(probe());
      if (kind == MotionKind::Skip)
        bench.skip({10, 10, -10}, to);
      else
        bench.move(kind, {10, 10, -10}, to);
      REQUIRE(!bench.world.events().empty());
      const ProbeEvent& event = bench.world.events().front();
      CHECK(event.outcome == Outcome::StartInside);
      CHECK(message(event).starts_with(
          "the run begins with the ball 13.000 mm inside the part, the centre of the "
          "ball at machine X10.000 Y10.000 Z-10.000: check where it begins (`--at`)"));
      for (std::size_t i = 1; i < bench.world.events().size(); ++i)
        CHECK(bench.world.events()[i].share > 0);
    }
  }
  // The ball is free, the stem is not.
  PartBuilder shelf;
  shelf.box({0, 0, 10}, {100, 60, 20});
  Bench bench(probe(), *finish(shelf));
  bench.move(MotionKind::Feed, {50, 30, 0}, {50, 30, -5});
  REQUIRE(bench.world.events().size() == 1);
  CHECK(message(bench.world.events()[0])
            .starts_with("the run begins with the stem of the stylus inside the part, "));
  // A stylus that is pressed a little, as after a touch, may go on; later motions begin where the last one
  // ended.
  Bench pressed(probe());
  pressed.move(MotionKind::Feed, {10, 10, 2.9}, {10, 10, 30});
  CHECK(pressed.outcomes().empty());
  pressed.move(MotionKind::Rapid, {10, 10, -10}, {10, 10, 30});
  for (const Outcome outcome : pressed.outcomes())
    CHECK(outcome != Outcome::StartInside);
}
