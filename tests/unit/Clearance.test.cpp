#include "sim/run/Clearance.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <memory>
#include <random>
#include <string>

using namespace dotek;

namespace {

sim::Part blockPart() {
  sim::PartBuilder builder;
  builder.box({0, 0, -20}, {100, 60, 0});
  std::string fault;
  return *builder.finish(fault);
}

} // namespace

TEST_CASE("clearance: as near as the nearest of many points of the path") {
  const sim::Part part = blockPart();
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-900, 900);
  for (int path = 0; path < 50; ++path) {
    sim::Clearance clearance(0);
    double least = 1e9;
    sim::Point3 from{place(random), place(random), 600 + place(random) / 4};
    for (int move = 0; move < 8; ++move) {
      const sim::Point3 to{place(random), place(random), 600 + place(random) / 4};
      clearance.follow(part, from, to);
      for (int i = 0; i <= 2000; ++i)
        least = std::min(least, part.distance(from + (to - from) * (i / 2000.0)));
      from = to;
    }
    CHECK(clearance.least() <= least * 1.011 + 0.5);
    CHECK(clearance.least() >= least - 0.5);
  }
}

TEST_CASE("clearance: near is the largest size of the part, and 50 mm at least") {
  CHECK(sim::nearDistance(blockPart()) == doctest::Approx(100));
  sim::PartBuilder small, endless;
  std::string fault;
  small.sphere({0, 0, 0}, 10);
  CHECK(sim::nearDistance(*small.finish(fault)) == 50);
  endless.halfSpace({0, 0, 0}, {0, 0, 1});
  CHECK(sim::nearDistance(*endless.finish(fault)) == 50);
}

TEST_CASE("clearance: a path through the part is near, between its ends too") {
  const sim::Part part = blockPart();
  sim::Clearance clearance(50);
  CHECK(clearance.follow(part, {-500, 30, -10}, {-400, 30, -10}));
  CHECK(!clearance.isNear());
  CHECK(clearance.follow(part, {-400, 30, -10}, {700, 30, -10}));
  CHECK(clearance.isNear());
}
