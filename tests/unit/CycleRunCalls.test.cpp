// What the statements of the cycle language do that the IR has as cycles by their names, against numbers
// thought out by hand.
#include "ir/CycleNames.h"
#include "tests/unit/CycleBench.h"

using namespace dotek;
using namespace dotek::tests;
using sim::Point3;

namespace {

ir::CycleArgument given(const std::string& name, double value, std::optional<Frame> frame = std::nullopt) {
  ir::CycleArgument out;
  out.parameter = name;
  out.value = ir::constant(value);
  out.frame = frame;
  return out;
}

ir::CallCycle cycleCall(std::string_view name, std::vector<ir::CycleArgument> arguments) {
  ir::CallCycle out;
  out.cycle = name;
  out.arguments = std::move(arguments);
  return out;
}

} // namespace

TEST_CASE("cycle run: set gives what was measured its coordinates in the system") {
  Bench bench;
  ir::CallCycle set = cycleCall(ir::kSetOffset, {given("measured x", 20), given("measured y", -3)});
  set.setting =
      ir::CycleSetting{ir::constant(55), {true, true, false}, {ir::constant(7), ir::constant(1), nullptr}};
  bench.add(std::move(set));
  const verify::Record record = bench.run();
  REQUIRE_MESSAGE(record.ending == verify::Ending::Finished, record.text);
  const Point3 zero = verify::standZeros()[0], other = verify::standZeros()[1];
  CHECK(record.zeros.at({55, 0}) == doctest::Approx(zero.x + 20 - 7));
  CHECK(record.zeros.at({55, 1}) == doctest::Approx(zero.y - 3 - 1));
  CHECK(record.zeros.at({55, 2}) == other.z);
  CHECK(record.pieces.empty()); // nothing moves
}

TEST_CASE("cycle run: set of a work offset or a tool that is none is an alarm") {
  for (const double system : {53.0, 60.0, 54.5}) {
    Bench bench;
    ir::CallCycle set = cycleCall(ir::kSetOffset, {given("measured x", 20)});
    set.setting =
        ir::CycleSetting{ir::constant(system), {true, false, false}, {ir::constant(0), nullptr, nullptr}};
    bench.add(std::move(set));
    CHECK(bench.run().ending == verify::Ending::Alarm);
  }
  Bench bench;
  bench.add(cycleCall(ir::kSetTool, {given("tool", 0), given("length", 80)}));
  CHECK(bench.run().ending == verify::Ending::Alarm);
}

TEST_CASE("cycle run: a tool offset gets its length, and the length in force stays") {
  Bench bench;
  bench.add(cycleCall(ir::kSetTool, {given("tool", 7), given("length", 80.02)}));
  const verify::Record record = bench.run();
  REQUIRE_MESSAGE(record.ending == verify::Ending::Finished, record.text);
  REQUIRE(record.tools.contains(7));
  CHECK(record.tools.at(7).wear + record.tools.at(7).geometry == doctest::Approx(80.02));
  near(record.end, record.start);
}

TEST_CASE(
    "cycle run: a touch along a direction finds the point of the surface, whatever the direction's length") {
  for (const double length : {1.0, 5.0}) {
    Bench bench;
    PartBuilder builder;
    builder.halfSpace({20, 20, 0}, {-std::sqrt(0.5), -std::sqrt(0.5), 0}); // through X20 Y20
    bench.take(builder);
    bench.add(cycleCall(ir::kSurfaceAlong,
                        {given("direction x", length), given("direction y", length), given("travel", 28)}));
    const ir::ResultName results[] = {ir::ResultName::PositionX, ir::ResultName::PositionY,
                                      ir::ResultName::PositionZ, ir::ResultName::Main};
    for (std::uint32_t i = 0; i < 4; ++i)
      bench.keep(101 + i, ir::result(results[i]));
    const verify::Record record = bench.run();
    REQUIRE_MESSAGE(record.ending == verify::Ending::Finished, record.text);
    CHECK(std::abs(record.stores.at(101) - 20) < kExact);
    CHECK(std::abs(record.stores.at(102) - 20) < kExact);
    CHECK(std::abs(record.stores.at(103) - kBall) < kExact); // the height of the ball's centre
    CHECK(std::abs(record.stores.at(104) - (20 * std::sqrt(2.0) - 28)) < kExact);
    near(record.end, record.start);
  }
}

TEST_CASE("cycle run: straight down a direction finds what a touch along z finds") {
  Bench bench;
  bench.box({-20, -20, -20}, {20, 20, -0.37});
  bench.entry.start = {0, 0, 12};
  // From the ball's centre, which is at Z15.
  bench.add(cycleCall(ir::kSurfaceAlong, {given("direction z", -1), given("travel", 15)}));
  bench.keep(101, ir::result(ir::ResultName::PositionZ));
  bench.keep(102, ir::result(ir::ResultName::Main));
  const verify::Record record = bench.run();
  REQUIRE_MESSAGE(record.ending == verify::Ending::Finished, record.text);
  CHECK(std::abs(record.stores.at(101) - -0.37) < kExact);
  CHECK(std::abs(record.stores.at(102) - 0.37) < kExact); // farther along the direction
}

TEST_CASE("cycle run: a touch that may miss goes on with its flag, back where it began") {
  for (const bool there : {true, false}) {
    Bench bench;
    bench.box({there ? 20.0 : 200.0, -20, -20}, {300, 20, 20});
    ir::CallCycle touch = cycleCall(ir::kSurface, {given("target x", 19, Frame::Here), given("miss", 1)});
    touch.axis = Axis::X;
    bench.add(std::move(touch));
    bench.keep(101, ir::result(ir::ResultName::ProbeError));
    const verify::Record record = bench.run();
    REQUIRE_MESSAGE(record.ending == verify::Ending::Finished, record.text);
    CHECK(record.stores.at(101) == (there ? 0 : 1));
    near(record.end, record.start);
  }
}

TEST_CASE("cycle run: an overtravel of the touch's own counts instead of the usual one") {
  for (const double beyond : {-0.001, 0.001}) {
    Bench bench;
    bench.inputs.overtravel = 10;
    bench.box({22 + beyond, -20, -20}, {60, 20, 20}); // expected at X20, searched to X22
    ir::CallCycle touch =
        cycleCall(ir::kSurface, {given("target x", 20, Frame::Here), given("overtravel", 2)});
    touch.axis = Axis::X;
    bench.add(std::move(touch));
    const verify::Record record = bench.run();
    CHECK(record.ending == (beyond < 0 ? verify::Ending::Finished : verify::Ending::Alarm));
  }
}

TEST_CASE("cycle run: a single touch is one contact of the probe, the usual one is two") {
  for (const bool once : {true, false}) {
    Bench bench;
    bench.box({20, -20, -20}, {60, 20, 20});
    ir::CallCycle touch =
        cycleCall(ir::kSurface, {given("target x", 20, Frame::Here), given("once", once ? 1 : 0)});
    touch.axis = Axis::X;
    bench.add(std::move(touch));
    sim::World world(*bench.part, bench.probe);
    const verify::Record record = bench.stand.run(bench.cycle, bench.inputs, world, bench.entry, {});
    REQUIRE_MESSAGE(record.ending == verify::Ending::Finished, record.text);
    CHECK(world.events().size() == (once ? 1 : 2));
  }
}

TEST_CASE("cycle run: a cycle of a macro set is not known here") {
  Bench bench;
  ir::CallCycle call = cycleCall("web", {});
  call.set = "some-set";
  bench.add(std::move(call));
  CHECK(bench.run().ending == verify::Ending::Inconclusive);
}
