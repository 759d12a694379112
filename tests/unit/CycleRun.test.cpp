// What a cycle measures by its meaning, against numbers thought out by hand.
#include "tests/Draws.h"
#include "tests/unit/CycleBench.h"

using namespace dotek;
using namespace dotek::tests;
using sim::Point3;

namespace {

// A bore of 30.02, 20 deep, whose middle lies at X0.3 Y-0.2; touched by four touches 8 below its edge. #101
// and #102 get the middle, #103 the size.
void boreByFour(Bench& bench, const sim::Placement& error = {}) {
  PartBuilder builder;
  builder.box({-40, -40, -20}, {40, 40, 0});
  builder.cylinder({0.3, -0.2, -20}, {0.3, -0.2, 0}, 15.01, PartBuilder::Action::Remove);
  bench.take(builder, error);
  bench.entry.start = {0, 0, 5};
  bench.move(ir::Motion::Protected, Frame::Here, {}, {}, -13);
  const auto right = bench.touch(Axis::X, 15, "right"), left = bench.touch(Axis::X, -15, "left");
  bench.move(ir::Motion::Protected, Frame::Work, {middle(right, left), nullptr, nullptr});
  const auto back = bench.touch(Axis::Y, 15, "back"), front = bench.touch(Axis::Y, -15, "front");
  bench.move(ir::Motion::Protected, Frame::Start, {}, {}, 0);
  bench.move(ir::Motion::Protected, Frame::Start, 0, 0, {});
  bench.keep(101, middle(right, left));
  bench.keep(102, middle(back, front));
  bench.keep(103, back - front);
}

} // namespace

TEST_CASE("cycle run: a bore that lies beside its place is measured as it is") {
  Bench bench;
  boreByFour(bench);
  const verify::Record record = bench.run();
  REQUIRE_MESSAGE(record.ending == verify::Ending::Finished, record.text);
  CHECK(record.events.empty());
  CHECK(record.measures.size() == 4);
  CHECK(std::abs(record.stores.at(101) - 0.3) < kExact);
  CHECK(std::abs(record.stores.at(102) - -0.2) < kExact);
  CHECK(std::abs(record.stores.at(103) - 30.02) < kExact);
  near(record.end, record.start);
}

TEST_CASE("cycle run: a bore stays what it is on a part that is shifted and turned") {
  for (int n = 0; n < draws(40, 10); ++n) {
    PartRandom random(static_cast<std::uint64_t>(n));
    const Point3 shift = {random.between(-0.5, 0.5), random.between(-0.5, 0.5), random.between(-0.5, 0.5)};
    const double turn = random.between(-3, 3), angle = turn * M_PI / 180;
    Bench bench;
    boreByFour(bench, {shift, {0, 0, turn}});
    const verify::Record record = bench.run();
    REQUIRE_MESSAGE(record.ending == verify::Ending::Finished, record.text);
    // The middle turns about the part's zero.
    CHECK(std::abs(record.stores.at(101) - (shift.x + 0.3 * std::cos(angle) + 0.2 * std::sin(angle))) <
          kExact);
    CHECK(std::abs(record.stores.at(102) - (shift.y + 0.3 * std::sin(angle) - 0.2 * std::cos(angle))) <
          kExact);
    CHECK(std::abs(record.stores.at(103) - 30.02) < kExact);
  }
}

TEST_CASE("cycle run: a noisy probe is off by its noise, three deviations at most, and right on average") {
  Bench bench;
  boreByFour(bench);
  constexpr double kNoise = 0.002;
  bench.probe.noise = kNoise;
  bench.probe.overtravel = 1;
  const int runs = draws(400, 100);
  double sum = 0;
  for (int n = 1; n <= runs; ++n) {
    const verify::Record record = bench.run(static_cast<std::uint64_t>(n));
    REQUIRE_MESSAGE(record.ending == verify::Ending::Finished, record.text);
    const double off = record.stores.at(103) - 30.02;
    CHECK(std::abs(off) <= 2 * 3 * kNoise + kExact); // two touches make a size
    sum += off;
  }
  CHECK(std::abs(sum / runs) <= 3 * kNoise * std::sqrt(2) / std::sqrt(runs));
  CHECK(std::abs(sum) > 0);
}

TEST_CASE("cycle run: the calibrated radius takes the way to the signal away to the side") {
  Bench bench;
  boreByFour(bench);
  bench.probe.preTravel = 0.01;
  bench.probe.overtravel = 1;
  const verify::Record record = bench.run();
  CHECK(std::abs(record.stores.at(103) - 30.02) < kExact);
}

TEST_CASE("cycle run: a touch down finds the surface with the lowest point of the ball") {
  Bench bench;
  bench.box({-20, -20, -20}, {20, 20, -0.37});
  bench.entry.start = {0, 0, 12};
  bench.keep(101, bench.touch(Axis::Z, -12, "top"));
  bench.keep(102, ir::result(ir::ResultName::ErrorZ));
  const verify::Record record = bench.run();
  REQUIRE_MESSAGE(record.ending == verify::Ending::Finished, record.text);
  CHECK(std::abs(record.stores.at(101) - -0.37) < kExact);
  CHECK(std::abs(record.stores.at(102) - -0.37) < kExact); // expected at Z0
  near(record.end, record.start);
  REQUIRE(record.measures.size() == 1);
  near(record.measures[0].nominal.at(0).point, verify::standZeros()[0]);
}

TEST_CASE("cycle run: a touch to a coordinate expects the surface there") {
  Bench bench;
  bench.box({30, -20, -20}, {60, 20, 20});
  bench.entry.start = {10, 0, 0};
  bench.keep(101, bench.touch(Axis::X, 29.8, "side", Frame::Work));
  bench.keep(102, ir::result(ir::ResultName::ErrorX));
  const verify::Record record = bench.run();
  REQUIRE_MESSAGE(record.ending == verify::Ending::Finished, record.text);
  CHECK(std::abs(record.stores.at(101) - 30) < kExact);
  CHECK(std::abs(record.stores.at(102) - 0.2) < kExact);
}

TEST_CASE("cycle run: a search goes as far as the overtravel, and what is not found ends the cycle where it "
          "began") {
  for (const double beyond : {-0.001, 0.001}) {
    Bench bench;
    bench.inputs.overtravel = 4;
    bench.box({24 + beyond, -20, -20}, {60, 20, 20}); // expected at X20
    bench.touch(Axis::X, 20, "side");
    const verify::Record record = bench.run();
    if (beyond < 0) {
      CHECK(record.ending == verify::Ending::Finished);
      continue;
    }
    CHECK(record.ending == verify::Ending::Alarm);
    CHECK(record.alarmKind == "probe-fail");
    near(record.end, record.start);
  }
}

TEST_CASE("cycle run: a protected move that meets something ends the cycle there") {
  Bench bench;
  bench.box({20, -20, -20}, {60, 20, 20});
  bench.move(ir::Motion::Protected, Frame::Here, 30, {}, {});
  const verify::Record record = bench.run();
  CHECK(record.ending == verify::Ending::Alarm);
  CHECK(record.alarmKind == "path-obstructed");
  near(record.end, record.start + Point3{20 - kBall, 0, 0});
}

TEST_CASE("cycle run: other moves into the part are collisions, and no alarm stops them") {
  for (const ir::Motion motion : {ir::Motion::Rapid, ir::Motion::Feed}) {
    Bench bench;
    bench.box({20, -20, -20}, {60, 20, 20});
    bench.move(motion, Frame::Here, 30, {}, {});
    const verify::Record record = bench.run();
    CHECK(record.ending == verify::Ending::Finished);
    REQUIRE(record.events.size() == 1);
    CHECK(record.events[0].first.outcome ==
          (motion == ir::Motion::Rapid ? sim::Outcome::RapidIntoPart : sim::Outcome::Overtravel));
  }
}

TEST_CASE("cycle run: a touch that begins in contact is an alarm") {
  Bench bench;
  bench.box({kBall, -20, -20}, {60, 20, 20});
  bench.touch(Axis::X, 3.5, "side");
  const verify::Record record = bench.run();
  CHECK(record.ending == verify::Ending::Alarm);
  CHECK(record.alarmKind == "probe-open");
}

TEST_CASE("cycle run: a touch with the probe off gets no signal") {
  Bench bench;
  bench.box({20, -20, -20}, {60, 20, 20});
  bench.entry.probeOn = false;
  bench.touch(Axis::X, 20, "side");
  const verify::Record record = bench.run();
  CHECK(record.ending == verify::Ending::Alarm);
  REQUIRE(record.events.size() == 1);
  CHECK(record.events[0].first.outcome == sim::Outcome::NotArmed);
}

TEST_CASE("cycle run: coordinates count from the frame that they name") {
  Bench bench;
  const Point3 zero = verify::standZeros()[0], other = verify::standZeros()[2];
  bench.entry.start = {5, 6, 7};
  bench.inputs.retract = 40;
  const auto ends = [&](const Point3& machine) {
    const verify::Record record = bench.run();
    REQUIRE_MESSAGE(record.ending == verify::Ending::Finished, record.text);
    near(record.end, machine);
  };
  bench.move(ir::Motion::Rapid, Frame::Work, 1, 2, 3);
  ends(zero + Point3{1, 2, 3});
  bench.move(ir::Motion::Rapid, Frame::Here, 1, {}, -1);
  ends(zero + Point3{2, 2, 2});
  bench.move(ir::Motion::Rapid, Frame::Start, 0, 10, {});
  ends(zero + Point3{5, 16, 2});
  bench.move(ir::Motion::Rapid, Frame::Retract, {}, {}, 2);
  ends(zero + Point3{5, 16, 42});
  bench.move(ir::Motion::Rapid, Frame::Work, {}, {}, 10,
             ir::ProbePoint::Centre); // the lowest point lies below it
  ends(zero + Point3{5, 16, 10 - kBall});
  bench.move(ir::Motion::Rapid, Frame::Machine, {}, {}, 0); // the gauge line of the spindle
  ends({zero.x + 5, zero.y + 16, -verify::kToolLength});
  ir::Move named;
  named.axes[0] = ir::Coordinate{ir::constant(4), Frame::Work, ir::constant(56)};
  bench.add(named);
  ends({other.x + 4, zero.y + 16, -verify::kToolLength});
}

TEST_CASE("cycle run: a setting gives the surface its coordinate in the system, and other axes stay") {
  Bench bench;
  bench.box({20, -20, -20}, {60, 20, 20});
  bench.set(Axis::X, 19.5, 56, 7);
  const verify::Record record = bench.run();
  REQUIRE_MESSAGE(record.ending == verify::Ending::Finished, record.text);
  const Point3 zero = verify::standZeros()[0], other = verify::standZeros()[2];
  CHECK(std::abs(record.zeros.at({56, 0}) - (zero.x + 20 - 7)) < kExact);
  CHECK(record.zeros.at({56, 1}) == other.y);
  CHECK(record.zeros.at({54, 0}) == zero.x);
}

TEST_CASE(
    "cycle run: what follows a setting of the active system counts in the corrected one, and start stays") {
  Bench bench;
  bench.box({20, -20, -20}, {60, 20, 20});
  bench.entry.start = {1, 0, 0};
  bench.set(Axis::X, 19, 54, 0);                          // the surface at X20 becomes X0
  bench.keep(101, ir::result(ir::ResultName::PositionX)); // measured before, so it keeps its number
  bench.move(ir::Motion::Rapid, Frame::Work, -30, {}, {});
  const Point3 zero = verify::standZeros()[0];
  verify::Record record = bench.run();
  REQUIRE_MESSAGE(record.ending == verify::Ending::Finished, record.text);
  near(record.end, zero + Point3{-10, 0, 0});
  CHECK(std::abs(record.stores.at(101) - 20) < kExact);
  bench.move(ir::Motion::Rapid, Frame::Start, 0, {}, {});
  record = bench.run();
  near(record.end, zero + Point3{1, 0, 0});
}

TEST_CASE("cycle run: values that are not there end the run and say so") {
  {
    Bench bench;
    const ir::VariableId left = bench.cycle.add(parameter("left", ir::Kind::Length));
    bench.inputs.values = {ir::Scalar::null()};
    bench.move(ir::Motion::Rapid, Frame::Here, {ir::variable(left), nullptr, nullptr});
    const verify::Record record = bench.run();
    CHECK(record.ending == verify::Ending::Inconclusive);
    CHECK(record.text.find("left out") != std::string::npos);
    CHECK(record.pieces.empty());
  }
  {
    Bench bench;
    bench.keep(101, ir::result(ir::ResultName::PositionX)); // nothing was measured
    CHECK(bench.run().ending == verify::Ending::Inconclusive);
  }
  {
    Bench bench;
    bench.keep(101, ir::binary(ir::BinaryOp::Divide, ir::constant(1), ir::constant(0)));
    const verify::Record record = bench.run();
    CHECK(record.ending == verify::Ending::Alarm);
    CHECK(record.text == "a division by zero");
  }
  {
    Bench bench;
    bench.move(ir::Motion::Rapid, Frame::Retract, {}, {}, 0);
    CHECK(bench.run().ending == verify::Ending::Inconclusive);
  }
}

TEST_CASE("cycle run: branches, loops and the end of a cycle") {
  Bench bench;
  const auto sum = bench.variable("sum", ir::Kind::Number), index = bench.variable("i", ir::Kind::Number);
  const ir::LabelId again = bench.cycle.addLabel({"again", {}}), out = bench.cycle.addLabel({"out", {}});
  bench.assign(sum, ir::constant(0));
  bench.assign(index, ir::constant(1));
  bench.add(ir::Label{again});
  bench.add(ir::Branch{ir::compare(ir::Relation::Greater, index, ir::constant(10)), out});
  bench.assign(sum, ir::binary(ir::BinaryOp::Add, sum, index));
  bench.assign(index, ir::binary(ir::BinaryOp::Add, index, ir::constant(1)));
  bench.add(ir::Jump{again});
  bench.add(ir::Label{out});
  bench.keep(101, sum);
  bench.add(ir::Return{});
  bench.keep(102, sum);
  const verify::Record record = bench.run();
  CHECK(record.ending == verify::Ending::Finished);
  CHECK(record.stores.at(101) == 55);
  CHECK_FALSE(record.stores.contains(102));
}

TEST_CASE("cycle run: a loop without an end is stopped by the limit") {
  Bench bench;
  bench.limits.simSteps = 10000;
  const ir::LabelId again = bench.cycle.addLabel({"again", {}});
  bench.add(ir::Label{again});
  bench.add(ir::Jump{again});
  const verify::Record record = bench.run();
  CHECK(record.ending == verify::Ending::Inconclusive);
  CHECK(record.overLimit);
  CHECK(record.text.find("sim-steps") != std::string::npos);
}

TEST_CASE("cycle run: checks come first, and their alarm ends the run before anything moves") {
  Bench bench;
  bench.cycle.checks.push_back(statement(ir::Alarm{"NO SUCH VALUE"}));
  bench.move(ir::Motion::Rapid, Frame::Here, 1, {}, {});
  const verify::Record record = bench.run();
  CHECK(record.ending == verify::Ending::Alarm);
  CHECK(record.text == "NO SUCH VALUE");
  CHECK(record.pieces.empty());
}

TEST_CASE("cycle run: what a rehearsal expects makes the part on which the cycle finds its nominals") {
  Bench bench;
  boreByFour(bench);
  const verify::CycleStand::Rehearsal rehearsal =
      bench.stand.rehearse(bench.cycle, bench.inputs, bench.probe, bench.entry);
  CHECK(rehearsal.ending == verify::Ending::Finished);
  REQUIRE(rehearsal.surfaces.size() == 4);
  near(rehearsal.surfaces[0].point, verify::standZeros()[0] + Point3{15, 0, -8 + kBall});
  near(rehearsal.surfaces[3].point, verify::standZeros()[0] + Point3{0, -15, -8 + kBall});
  bench.part = verify::partOf(rehearsal.surfaces, kBall, 10, {});
  const verify::Record record = bench.run();
  REQUIRE_MESSAGE(record.ending == verify::Ending::Finished, record.text);
  CHECK(record.events.empty());
  CHECK(std::abs(record.stores.at(101)) < kExact);
  CHECK(std::abs(record.stores.at(103) - 30) < kExact);
}

TEST_CASE("cycle run: a bore in one statement is touched along X, then through that middle along Y") {
  Bench bench;
  PartBuilder builder;
  builder.box({-40, -40, -20}, {40, 40, 0});
  builder.cylinder({0.3, -0.2, -20}, {0.3, -0.2, 0}, 15.01, PartBuilder::Action::Remove);
  bench.take(builder);
  bench.entry.start = {0, 0, -8};
  ir::Measure node;
  node.feature = ir::Feature::Bore;
  node.diameter = ir::constant(30);
  ir::OffsetSetting setting;
  setting.system = ir::constant(55);
  setting.nominal[0] = ir::constant(0);
  setting.nominal[1] = ir::constant(100);
  node.setting = std::move(setting);
  bench.add(std::move(node));
  bench.keep(101, ir::result(ir::ResultName::Size));
  const verify::Record record = bench.run();
  REQUIRE_MESSAGE(record.ending == verify::Ending::Finished, record.text);
  const Point3 zero = verify::standZeros()[0];
  CHECK(std::abs(record.stores.at(101) - 30.02) < kExact);
  CHECK(std::abs(record.zeros.at({55, 0}) - (zero.x + 0.3)) < kExact);
  CHECK(std::abs(record.zeros.at({55, 1}) - (zero.y - 0.2 - 100)) < kExact);
  near(record.end, record.start);
}
