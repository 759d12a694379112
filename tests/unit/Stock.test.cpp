// Material that tools cut from a block, and what is left of it beside the finished part.
#include "sim/stock/StockRun.h"
#include "tests/Draws.h"

#include <cmath>
#include <doctest/doctest.h>
#include <random>

using namespace dotek;
using namespace dotek::sim;

namespace {

constexpr StockBlock kBlock{{0, 0, -20}, {40, 30, 0}, 0.5};

// Of the tool's lower side over a place, by many steps along the way.
double bySteps(const CutterShape& tool, const Point3& from, const Point3& to, double x, double y) {
  double out = std::numeric_limits<double>::infinity();
  constexpr int kSteps = 4000;
  for (int i = 0; i <= kSteps; ++i) {
    const Point3 tip = from + (to - from) * (static_cast<double>(i) / kSteps);
    const double distance = std::hypot(x - tip.x, y - tip.y);
    if (distance <= tool.radius()) out = std::min(out, tip.z + tool.bottom(distance));
  }
  return out;
}

MachineMotion motion(const Point3& from, const Point3& to, MotionKind kind = MotionKind::Feed) {
  MachineMotion out;
  out.kind = kind;
  out.from = {from.x, from.y, from.z};
  out.to = {to.x, to.y, to.z};
  return out;
}

StockFile fileOf(const Part& part, CutterShape tool) {
  StockFile out;
  out.block = kBlock;
  out.part = part;
  out.tools.push_back({1, tool, std::nullopt});
  return out;
}

Part partOf(PartBuilder& builder) {
  std::string fault;
  const std::unique_ptr<Part> part = builder.finish(fault);
  REQUIRE_MESSAGE(part != nullptr, fault);
  return *part;
}

} // namespace

TEST_CASE("stock: the lower side of a tool is flat, rounded, and a ball's") {
  CHECK(CutterShape{10, 0}.bottom(5) == 0);
  CHECK(CutterShape{10, 2}.bottom(3) == 0);
  CHECK(CutterShape{10, 2}.bottom(5) == doctest::Approx(2));
  CHECK(CutterShape{10, 2}.bottom(4) == doctest::Approx(2 - std::sqrt(3)));
  CHECK(CutterShape{10, 5}.bottom(0) == 0);
  CHECK(CutterShape{10, 5}.bottom(3) == doctest::Approx(1));
}

TEST_CASE("stock: a slot is as wide as its tool, as deep as its tip, and its volume is counted") {
  StockMap map(kBlock);
  const StockMap::Cut cut = map.cut({10, 0}, {-20, 15, -3}, {60, 15, -3});
  CHECK(cut.deepest == doctest::Approx(3));
  for (std::size_t row = 0; row < map.rows(); ++row)
    CHECK(map.height(40, row) == doctest::Approx(std::abs(map.y(row) - 15) <= 5 ? -3.0 : 0.0));
  CHECK(map.removed() == doctest::Approx(40.0 * 10 * 3));
  // The same way once more takes nothing; below the block nothing is left.
  CHECK(map.cut({10, 0}, {-20, 15, -3}, {60, 15, -3}).deepest == 0);
  map.cut({10, 0}, {20, 15, 0}, {20, 15, -50});
  CHECK(map.height(40, 30) == -20);
}

TEST_CASE("stock: a ball leaves a groove of its radius") {
  StockMap map(kBlock);
  map.cut({12, 6}, {-10, 15, -2}, {50, 15, -2});
  for (std::size_t row = 0; row < map.rows(); ++row) {
    const double beside = std::abs(map.y(row) - 15);
    const double left = beside >= 6 ? 0 : std::min(0.0, -2 + 6 - std::sqrt(36 - beside * beside));
    CHECK(map.height(20, row) == doctest::Approx(left));
  }
}

TEST_CASE("stock: what is left after moves in any direction is what many steps leave") {
  std::mt19937 random(7); // the same in each run
  const auto between = [&](double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random);
  };
  for (int i = 0; i < tests::draws(60, 12); ++i) {
    const double diameter = between(2, 16);
    const double corner = i % 3 == 0 ? 0 : i % 3 == 1 ? diameter / 2 : between(0, diameter / 2);
    const Point3 from{between(-5, 45), between(-5, 35), between(-15, 5)};
    Point3 to{between(-5, 45), between(-5, 35), between(-15, 5)};
    if (i % 7 == 0) to.x = from.x;
    if (i % 11 == 0) to = {from.x, from.y, to.z};
    StockMap map(kBlock);
    map.cut({diameter, corner}, from, to);
    double farthest = 0;
    for (std::size_t row = 0; row < map.rows(); row += 3)
      for (std::size_t column = 0; column < map.columns(); column += 3) {
        const double stepped =
            std::clamp(bySteps({diameter, corner}, from, to, map.x(column), map.y(row)), -20.0, 0.0);
        // At the rim of a flat tool the steps miss a little of the way.
        const double lower = stepped - map.height(column, row);
        CHECK(lower > -1e-9);
        if (corner > 0.2 * diameter) farthest = std::max(farthest, lower);
      }
    CAPTURE(i);
    CHECK(farthest < 0.15);
  }
}

TEST_CASE(
    "stock: beside the part what is left over counts square to its surface, and what is cut into it too") {
  // A plane at 30 degrees, cut by a ball whose centre goes along lines beside it.
  const double angle = std::acos(-1.0) / 6;
  const Point3 normal{0, -std::sin(angle), std::cos(angle)};
  for (const double off : {0.0, 0.2, -0.2}) {
    PartBuilder builder;
    builder.box({-10, -10, -40}, {50, 40, 10});
    builder.halfSpace({0, 0, -18}, normal, PartBuilder::Action::Keep);
    const Part part = partOf(builder);
    StockRun run(fileOf(part, {8, 4}));
    const double step = 0.05;
    for (double along = -10; along < 50; along += step) {
      const Point3 foot{0, along * std::cos(angle), -18 + along * std::sin(angle)};
      const Point3 centre = foot + normal * (4 + off);
      const Point3 tip = centre - Point3{0, 0, 4};
      REQUIRE_FALSE(run.moved(motion({-10, tip.y, tip.z}, {50, tip.y, tip.z}), 0, 0));
    }
    const auto margin = run.margin();
    REQUIRE(margin);
    CHECK(margin->unknown == 0);
    const double scallop = step * step / 8 / 4; // between two passes
    CHECK(margin->most == doctest::Approx(std::max(0.0, off) + scallop).epsilon(0.05));
    CHECK(margin->least == doctest::Approx(std::min(0.0, off)).epsilon(0.01));
    CHECK((margin->under > 0) == (off < 0));
    CHECK((margin->over > 0) == (off > 0));
  }
}

TEST_CASE("stock: a cut through the part is as deep as the part, and no material that is left") {
  PartBuilder builder;
  builder.box({0, 0, -20}, {40, 30, -2});
  StockRun run(fileOf(partOf(builder), {10, 0}));
  run.moved(motion({20, 15, 5}, {20, 15, -25}), 1, 0);
  const auto margin = run.margin();
  REQUIRE(margin);
  CHECK(margin->least == doctest::Approx(-18));
  CHECK(margin->most == doctest::Approx(2));
}

TEST_CASE("stock: rapids that cut, tools that nobody knows, lengths, and moves from nowhere") {
  StockFile file = fileOf(Part(), {10, 0});
  file.tools.push_back({2, {6, 3}, 80.0});
  file.zero = {100, 200, -300};
  StockRun run(file);
  CHECK_FALSE(run.margin());
  const Point3 high{120, 215, -200};
  CHECK_FALSE(run.moved(motion(high, {120, 215, -298}, MotionKind::Rapid), 1, 0));
  const auto rapid = run.moved(motion({120, 215, -298}, {120, 215, -305}, MotionKind::Rapid), 1, 0);
  REQUIRE(rapid);
  CHECK(rapid->event == StockRun::Event::Rapid);
  CHECK(rapid->depth == doctest::Approx(5));
  // The control's length, or that of the file.
  CHECK_FALSE(run.moved(motion({110, 210, -290}, {110, 210, -295}), 1, 15));
  CHECK(run.map().height(20, 20) == doctest::Approx(-10));
  CHECK_FALSE(run.moved(motion({130, 205, -200}, {130, 205, -224}), 2, 15));
  CHECK(run.map().height(60, 10) > -4.1);
  CHECK(run.map().height(60, 10) < -3.9);
  const auto unknown = run.moved(motion({130, 205, -200}, {130, 205, -310}), 7, 0);
  REQUIRE(unknown);
  CHECK(unknown->event == StockRun::Event::UnknownTool);
  CHECK_FALSE(run.moved(motion({130, 205, -200}, {130, 205, -310}), 7, 0)); // said once
  MachineMotion nowhere = motion({130, 205, -200}, {130, 205, -310});
  nowhere.known = false;
  CHECK_FALSE(run.moved(nowhere, 1, 0));
  CHECK(run.lost() == 1);
}
