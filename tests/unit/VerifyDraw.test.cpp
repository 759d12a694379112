// Drawn values: the same for the same seed, within their bounds, and often such that the cycle runs.
#include "tests/GoldenRunner.h"
#include "tests/unit/IrHelper.h"
#include "tests/unit/VerifyFolder.h"
#include "verify/Bounds.h"
#include "verify/Random.h"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <fmt/format.h>
#include <set>

using namespace dotek;
using namespace dotek::tests;
using verify::Case;
using verify::DrawField;
using verify::Draws;

namespace {

DrawField field(const std::string& name, std::optional<double> initial, int decimals = 2,
                ir::Kind kind = ir::Kind::Length) {
  DrawField out;
  out.name = name;
  out.kind = kind;
  out.initial = initial;
  out.decimals = decimals;
  return out;
}

const std::vector<std::string> kHosts = {"tool_radius", "retract",    "clearance",   "start_x",    "start_y",
                                         "start_z",     "overtravel", "return_feed", "tool_offset"};

Draws draws(std::uint64_t seed = 1) {
  DrawField count = field("N", 3, 0, ir::Kind::Count);
  count.thresholds = {1, 8};
  return {{field("Z", -5), field("A", 12), field("B", 0), field("C", {}), field("D", 7.125),
           field("G", 55, 0, ir::Kind::WorkOffset), count, field("F", 200, 0, ir::Kind::Feed),
           field("T", 45, 1, ir::Kind::Angle), field("S", 1, 0, ir::Kind::Flag)},
          kHosts,
          {},
          seed};
}

bool same(const Case& a, const Case& b) {
  return a.values == b.values && a.hosts == b.hosts && a.system == b.system &&
         a.error.shift == b.error.shift && a.error.turn == b.error.turn && a.stream == b.stream;
}

bool isMultiple(double value, int decimals) {
  const double units = std::pow(10, decimals);
  return value == std::round(value * units) / units;
}

// Of `count` proposals, those that pass the checks and reach their touches.
double accepted(const std::filesystem::path& folder, int count) {
  VerifyFolder cycle(folder.string());
  const Draws drawn = cycle.draws(20261121);
  int good = 0;
  for (int n = 0; n < count; ++n) {
    Case each = drawn.propose(static_cast<std::uint64_t>(n), 0);
    if (cycle.judge(each, drawn).empty()) ++good;
  }
  return static_cast<double>(good) / count;
}

} // namespace

TEST_CASE("verify random: the numbers of SplitMix64") {
  verify::Random random(1234567);
  CHECK(random.next() == 6457827717110365317u);
  CHECK(random.next() == 3203168211198807973u);
  verify::Random other(7);
  for (int n = 0; n < 1000; ++n) {
    const std::int64_t whole = other.whole(-2, 2);
    CHECK((whole >= -2 && whole <= 2));
  }
}

TEST_CASE("draws: seed, case and attempt decide, and nothing else") {
  const Draws one = draws(), two = draws(), three = draws(2);
  const Case first = one.propose(17, 3);
  for (std::uint64_t n = 0; n < 50; ++n)
    (void)one.propose(n, 1);
  CHECK(same(first, one.propose(17, 3)));
  CHECK(same(first, two.propose(17, 3)));
  CHECK_FALSE(same(first, one.propose(18, 3)));
  CHECK_FALSE(same(first, one.propose(17, 4)));
  CHECK_FALSE(same(first, three.propose(17, 3)));
  CHECK(same(one.edge(5), two.edge(5)));
  CHECK_FALSE(same(one.edge(5), one.edge(6)));

  // A field that is fixed leaves the others as they were; so does a host.
  std::vector<DrawField> fields = one.fields();
  fields[1].fixed = 3.5;
  const Draws fixed(fields, kHosts, {{"retract", 12.5}}, 1);
  Case expected = first;
  expected.values["A"] = 3.5;
  expected.hosts["retract"] = 12.5;
  CHECK(same(fixed.propose(17, 3), expected));
}

TEST_CASE("draws: values are multiples of the last place, within bounds, of both signs") {
  const Draws drawn = draws();
  int negative = 0, kept = 0, small = 0, large = 0;
  std::set<double> systems, counts, flags;
  constexpr int kCases = 4000;
  for (std::uint64_t n = 0; n < kCases; ++n) {
    const Case each = drawn.propose(n, 0);
    for (const DrawField& f : drawn.fields()) {
      const double value = each.values.at(f.name);
      CHECK(isMultiple(value, f.decimals));
      CHECK(std::abs(value) < 999);
      CHECK_FALSE((value == 0 && std::signbit(value)));
    }
    negative += each.values.at("A") < 0 ? 1 : 0;
    kept += each.values.at("A") == 12 ? 1 : 0;
    small += std::abs(each.values.at("B")) < 1 ? 1 : 0;
    large += std::abs(each.values.at("B")) > 50 ? 1 : 0;
    systems.insert(each.values.at("G"));
    counts.insert(each.values.at("N"));
    flags.insert(each.values.at("S"));
    CHECK(each.values.at("F") > 0);
    CHECK(each.values.at("N") >= 0);
    CHECK(std::abs(each.values.at("T")) <= 180);
    CHECK((each.system >= 54 && each.system <= 59));
    CHECK(each.system != each.values.at("G"));
    CHECK_FALSE(each.edge);
  }
  CHECK(negative > kCases / 10);
  CHECK(negative < kCases * 3 / 10);
  CHECK(kept > kCases / 20);
  CHECK(small > kCases / 20);
  CHECK(large > kCases / 10);
  CHECK(systems == std::set<double>{54, 55, 56, 57, 58, 59});
  CHECK(counts.contains(0)); // on the other side of a threshold
  CHECK(counts.contains(9));
  CHECK(flags == std::set<double>{0, 1});
}

TEST_CASE("draws: thresholds get values on both sides") {
  DrawField depth = field("P", 3, 1, ir::Kind::Number);
  depth.thresholds = {2, 10};
  const Draws drawn({depth}, {}, {}, 1);
  int below = 0, between = 0, above = 0, at = 0;
  for (std::uint64_t n = 0; n < 1000; ++n) {
    const double value = drawn.propose(n, 0).values.at("P");
    (value < 2 ? below : value > 10 ? above : between) += 1;
    at += value == 2 || value == 10 ? 1 : 0;
  }
  CHECK(below > 100);
  CHECK(between > 300);
  CHECK(above > 100);
  CHECK(at > 20);
}

TEST_CASE("draws: hosts and errors stay where the probe can work") {
  const Draws drawn = draws();
  int usual = 0, plain = 0;
  for (std::uint64_t n = 0; n < 2000; ++n) {
    const Case each = drawn.propose(n, 0);
    const double radius = each.hosts.at("tool_radius");
    CHECK((radius >= 0.5 && radius <= 4));
    usual += radius >= 1 && radius <= 3 ? 1 : 0;
    for (const auto& [name, value] : each.hosts)
      CHECK(isMultiple(value, 3));
    CHECK(std::abs(each.hosts.at("start_x")) <= 100);
    CHECK((each.hosts.at("overtravel") >= 2 && each.hosts.at("overtravel") <= 10));
    CHECK(each.hosts.at("return_feed") > 0);
    CHECK(each.hosts.at("tool_offset") >= 1);
    CHECK(std::abs(each.error.shift.x) <= std::min(0.3, radius / 3));
    CHECK(std::abs(each.error.shift.y) <= std::min(0.3, radius / 3));
    CHECK((each.error.shift.z >= 0.02 && each.error.shift.z <= 0.4));
    CHECK(std::abs(each.error.turn) <= 0.3);
    plain += each.error.turn == 0 ? 1 : 0;
  }
  CHECK(usual > 1400);
  CHECK(plain > 100);
}

TEST_CASE("draws: hosts that depend on the path, and an error that the ball bears") {
  using frontend::gibbs::PathMove;
  const auto move = [](PathMove::Kind kind, double x, double z) { return PathMove{kind, x, 0, z, {}}; };
  const std::vector<PathMove> way = {
      move(PathMove::Kind::FeedZ, 0, 20),  move(PathMove::Kind::FeedZ, 0, -5),
      move(PathMove::Kind::FeedX, 0.3, 0), move(PathMove::Kind::FeedX, 0, 0),
      move(PathMove::Kind::FeedZ, 0, 12),  move(PathMove::Kind::FeedZ, 0, 11.9),
      move(PathMove::Kind::FeedZ, 0, 20)};
  const verify::DrawnPath path = verify::drawnPath(way, {0, 0, 150}, 0, 2);
  REQUIRE(path.touches.size() == 2);
  const Draws drawn = draws();
  std::set<double> clearances;
  for (std::uint64_t n = 0; n < 200; ++n) {
    Case each = drawn.propose(n, 0);
    drawn.settleHosts(each, path);
    const double clearance = each.hosts.at("clearance"), start = each.hosts.at("start_z");
    CHECK((clearance >= 12 && clearance <= 20));
    CHECK((start >= 20 && start <= 80.001));
    CHECK((isMultiple(clearance, 3) && isMultiple(start, 3)));
    clearances.insert(clearance);
    CHECK(std::abs(each.error.shift.x) <= 0.1); // a third of the path of 0.3 mm
    CHECK((each.error.shift.z > 0 && each.error.shift.z <= 0.05));
    Case again = each;
    drawn.settleHosts(again, path);
    CHECK(same(again, each));
  }
  CHECK(clearances.size() > 100);

  // Given ones stay, and so do those that nobody asked for.
  const Draws given({field("Z", -5)}, {"start_x"}, {{"clearance", 3}}, 1);
  Case each = given.propose(0, 0);
  given.settleHosts(each, path);
  CHECK(each.hosts.at("clearance") == 3);
  CHECK_FALSE(each.hosts.contains("start_z"));
}

TEST_CASE("draws: edge cases hold what is illegal, one field at a time first") {
  DrawField length = field("A", 12);
  length.thresholds = {2.5};
  const Draws drawn({length, field("G", 55, 1, ir::Kind::WorkOffset)}, {"tool_radius"}, {}, 1);
  std::set<double> lengths, offsets;
  bool active = false, radius = false;
  for (std::uint64_t n = 0; n < 60; ++n) {
    const Case each = drawn.edge(n);
    CHECK(each.edge);
    const double a = each.values.at("A"), g = each.values.at("G");
    lengths.insert(a);
    offsets.insert(g);
    active = active || each.system == g;
    radius = radius || a == each.hosts.at("tool_radius");
    CHECK(isMultiple(a, 2));
    CHECK(isMultiple(g, 1));
    CHECK(std::abs(a) < 1000);
  }
  for (const double value : {0.0, 2.5, 2.49, 2.51, 999.99, -999.99, 0.01, -0.01, -12.0})
    CHECK(lengths.contains(value));
  for (const double value : {54.5, 53.0, 60.0, 0.0, -54.0, 54.0, 59.0, 53.9, 59.1, 999.9})
    CHECK(offsets.contains(value));
  CHECK(active);
  CHECK(radius);

  DrawField fixed = field("A", 12);
  fixed.fixed = 12;
  const Draws nothing({fixed}, {}, {}, 1);
  CHECK(nothing.edge(3).values.at("A") == 12);
}

TEST_CASE("draws: edge cases do not depend on how many of them are asked for") {
  ir::Cycle cycle;
  const ir::VariableId a = cycle.add(parameter("A", ir::Kind::Length)),
                       b = cycle.add(parameter("B", ir::Kind::Length));
  for (int i = 0; i < 40; ++i)
    cycle.checks.push_back(statement(ir::Branch{
        ir::compare(ir::Relation::Greater, ir::variable(i % 3 == 0 ? b : a), ir::constant(3.5 + i)), 1}));
  cycle.checks.push_back(statement(ir::Return{}));
  cycle.checks.push_back(statement(ir::Label{1}));
  cycle.checks.push_back(statement(ir::Alarm{}));
  const auto bounds = std::make_shared<const verify::Bounds>(cycle);
  const auto with = [&](std::uint64_t edges) {
    return Draws({field("A", 2), field("B", 1)}, {"tool_radius"}, {}, 5, bounds, edges);
  };
  const Draws all = with(UINT64_MAX);
  std::set<double> met;
  for (const std::uint64_t count : {1u, 2u, 7u, 30u, 200u}) {
    const Draws few = with(count);
    for (std::uint64_t n = 0; n < count; ++n) {
      CAPTURE(count);
      CAPTURE(n);
      const Case one = few.edge(n), other = all.edge(n);
      CHECK(same(one, other));
      met.insert(one.values.at("A"));
    }
  }
  CHECK(met.contains(4.5)); // where a comparison turns, and beside it
  CHECK(met.contains(4.51));
}

TEST_CASE("draws: beside the bound of a whole number lie whole numbers, where a check lets no others pass") {
  const auto rejected = [](ir::ConditionPtr condition) {
    return statement(ir::Branch{std::move(condition), 1});
  };
  const auto met = [&](bool whole, double low, double high) {
    ir::Cycle cycle;
    const ir::VariableId t = cycle.add(parameter("T", ir::Kind::ToolOffset));
    cycle.checks.push_back(rejected(ir::compare(ir::Relation::Less, ir::variable(t), ir::constant(low))));
    cycle.checks.push_back(rejected(ir::compare(ir::Relation::Greater, ir::variable(t), ir::constant(high))));
    if (whole)
      cycle.checks.push_back(rejected(ir::compare(ir::Relation::NotEqual, ir::variable(t),
                                                  ir::unary(ir::UnaryOp::Truncate, ir::variable(t)))));
    cycle.checks.push_back(statement(ir::Return{}));
    cycle.checks.push_back(statement(ir::Label{1}));
    cycle.checks.push_back(statement(ir::Alarm{}));
    const auto bounds = std::make_shared<const verify::Bounds>(cycle);
    const Draws drawn({field("T", 7, 3, ir::Kind::ToolOffset)}, {}, {}, 5, bounds, 40);
    std::set<double> out;
    for (std::uint64_t n = 0; n < 9; ++n)
      out.insert(drawn.edge(n).values.at("T"));
    return out;
  };
  const std::set<double> whole = met(true, 2, 40);
  for (const double value : {1, 2, 3, 39, 40, 41})
    CHECK_MESSAGE(whole.contains(value), value);
  const std::set<double> between = met(true, 1.5, 40.5);
  for (const double value : {1, 2, 40, 41})
    CHECK_MESSAGE(between.contains(value), value);
  const std::set<double> any = met(false, 2, 40);
  for (const double value : {1.999, 2.0, 2.001, 39.999, 40.0, 40.001})
    CHECK_MESSAGE(any.contains(value), value);
}

TEST_CASE("draws: the examples are reached by a fifth of the proposals and more") {
  for (const char* name : {"bore", "corner-xyz", "surface-x", "surface-y", "surface-z"}) {
    CAPTURE(name);
    CHECK(accepted(root() / "examples" / name, 200) > 0.3);
  }
}

TEST_CASE("draws: so are the cycles of the corpus") {
  std::filesystem::path folder;
  if (!haveCorpus(folder)) return;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "gibbs")) {
    CAPTURE(entry.path().string());
    CHECK(accepted(entry.path(), 200) > 0.3);
  }
}
