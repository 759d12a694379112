// Random parts: what holds of every one of them.
#include "tests/Draws.h"
#include "tests/unit/PartHelper.h"

#include <doctest/doctest.h>

using namespace dotek::sim;
using namespace dotek::tests;

namespace {

const std::uint64_t kParts = draws<std::uint64_t>(50, 12);

// Directions that cover a sphere evenly.
std::vector<Point3> directions(int count) {
  std::vector<Point3> out;
  for (int n = 0; n < count; ++n) {
    const double z = 1 - (2 * n + 1.0) / count, r = std::sqrt(1 - z * z), a = n * 2.399963229728653;
    out.push_back({r * std::cos(a), r * std::sin(a), z});
  }
  return out;
}

} // namespace

TEST_CASE("part: the sign of the distance is membership, and no point nearer than it is on the other side") {
  int inside = 0;
  for (std::uint64_t seed = 0; seed < kParts; ++seed) {
    INFO("seed " << seed);
    const RandomPart random = RandomPart::make(seed);
    PartRandom numbers(seed + 1000);
    int wrong = 0;
    for (int n = 0; n < 200; ++n) {
      const Point3 p = numbers.point(14);
      const Part::Nearest nearest = random.part->nearest(p);
      const double d = nearest.distance;
      const bool in = random.contains(p);
      inside += in ? 1 : 0;
      wrong += std::abs(d) > 1e-9 && (d < 0) != in ? 1 : 0;
      for (int k = 0; k < 20; ++k) {
        const Point3 q = p + numbers.direction() * (std::abs(d) * numbers.between(0.5, 0.999999));
        wrong += random.contains(q) != in ? 1 : 0;
      }
      // The nearest point is of the surface, as far away as is said, and the material lies after it.
      wrong += std::abs(lengthOf(p - nearest.point) - std::abs(d)) > 1e-8 ? 1 : 0;
      bool material = false, air = false;
      for (int k = 0; k < 20000 && !(material && air); ++k) {
        const bool here = random.contains(nearest.point + numbers.direction() * 1e-5);
        (here ? material : air) = true;
      }
      if (!(material && air)) {
        ++wrong;
        MESSAGE("no surface at " << nearest.point.x << " " << nearest.point.y << " " << nearest.point.z);
      }
    }
    CHECK(wrong == 0);
  }
  CHECK(inside > (fewDraws() ? 70 : 300));
}

TEST_CASE("part: a contact is one, and before it nothing is met") {
  const std::vector<Point3> around = directions(1500);
  int contacts = 0, misses = 0;
  for (std::uint64_t seed = 0; seed < kParts; ++seed) {
    INFO("seed " << seed);
    const RandomPart random = RandomPart::make(seed);
    PartRandom numbers(seed + 2000);
    for (int n = 0; n < 6; ++n) {
      const double radius = numbers.between(0.3, 4);
      const Point3 from = numbers.direction() * 45;
      const Point3 to = from * -0.6 + numbers.point(12);
      const auto touch = firstContact(*random.part, radius, from, to);
      const double share = touch ? touch->share : 1;
      ++(touch ? contacts : misses);
      if (touch) {
        CHECK(!touch->atStart);
        CHECK(lengthOf(touch->point - touch->centre) == doctest::Approx(radius).epsilon(1e-9));
        CHECK(std::abs(random.part->distance(touch->centre) - radius) < 1e-9);
      }
      // A slow march with the membership of points of the ball.
      int early = 0;
      for (int step = 0; step <= 60; ++step) {
        const Point3 centre = from + (to - from) * (share * step / 60);
        for (const Point3& d : around)
          early += random.contains(centre + d * (radius - 1e-6)) ? 1 : 0;
      }
      CHECK(early == 0);
    }
  }
  CHECK(contacts > (fewDraws() ? 12 : 50));
  CHECK(misses > (fewDraws() ? 2 : 10));
}

TEST_CASE("part: to move part and probe together changes nothing") {
  for (std::uint64_t seed = 0; seed < kParts; ++seed) {
    INFO("seed " << seed);
    const RandomPart random = RandomPart::make(seed);
    PartRandom numbers(seed + 3000);
    const Placement nominal{numbers.point(300), numbers.point(180)};
    const Placement error{numbers.point(1), numbers.point(2)};
    const Part moved = random.part->placed(nominal, error);
    for (int n = 0; n < 10; ++n) {
      const Point3 from = numbers.direction() * 45;
      const Point3 to = from * -0.6 + numbers.point(12);
      const auto here = firstContact(*random.part, 2, from, to);
      const auto there = firstContact(moved, 2, moved.toMachine(from), moved.toMachine(to));
      REQUIRE(here.has_value() == there.has_value());
      if (here) {
        CHECK(std::abs(here->share - there->share) * lengthOf(to - from) < 1e-7);
        CHECK(lengthOf(moved.toMachine(here->centre) - there->centre) < 1e-7);
      }
    }
  }
}

TEST_CASE("part: a capsule collides where the balls along its axis do") {
  int hits = 0;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    INFO("seed " << seed);
    const RandomPart random = RandomPart::make(seed);
    PartRandom numbers(seed + 4000);
    for (int n = 0; n < 4; ++n) {
      const double radius = numbers.between(0.5, 5);
      const Point3 from = numbers.direction() * 50;
      const Point3 axis = numbers.direction() * numbers.between(0, 25);
      const Point3 way = from * -1.7 + numbers.point(12);
      const auto share = firstCollision(*random.part, {from, from + axis, radius}, way);
      hits += share ? 1 : 0;
      constexpr int kBalls = 60;
      double first = 2;
      for (int k = 0; k <= kBalls; ++k) {
        const Point3 a = from + axis * (static_cast<double>(k) / kBalls);
        if (const auto touch = firstContact(*random.part, radius, a, a + way))
          first = std::min(first, touch->share);
      }
      if (first <= 1) {
        REQUIRE(share);
        CHECK(*share <= first + 1e-6);
      }
      if (!share) continue;
      // Some ball of the axis is as near as is said.
      double least = 1e9;
      for (int k = 0; k <= 20 * kBalls; ++k)
        least = std::min(least, random.part->distance(from + way * *share + axis * (k / (20.0 * kBalls))));
      CHECK(least - radius < 2e-3 + lengthOf(axis) / (40 * kBalls));
    }
  }
  CHECK(hits > 20);
}

TEST_CASE("part: whether a capsule collides is whether it does somewhere") {
  int hits = 0, misses = 0;
  for (std::uint64_t seed = 0; seed < kParts; ++seed) {
    INFO("seed " << seed);
    const RandomPart random = RandomPart::make(seed);
    PartRandom numbers(seed + 5000);
    for (int n = 0; n < 20; ++n) {
      const Point3 from = numbers.direction() * numbers.between(5, 50);
      const Capsule capsule{from, from + numbers.direction() * numbers.between(0, 25),
                            numbers.between(0.5, 5)};
      const Point3 way = from * -numbers.between(0, 1.7) + numbers.point(12);
      const bool found = firstCollision(*random.part, capsule, way).has_value();
      CHECK(collides(*random.part, capsule, way) == found);
      ++(found ? hits : misses);
    }
  }
  CHECK(hits > (fewDraws() ? 25 : 100));
  CHECK(misses > (fewDraws() ? 25 : 100));
}

TEST_CASE("part: boxes have edges, outward and inward ones") {
  PartBuilder builder;
  builder.box({0, 0, 0}, {20, 10, 50});
  builder.box({0, 0, 0}, {10, 20, 50});
  const std::unique_ptr<Part> angle = finish(builder);
  // In the corner of the L the nearest of the surface is its inner edge.
  const Part::Nearest inner = angle->nearest({8, 8, 25});
  CHECK(inner.distance == doctest::Approx(-std::sqrt(8)).epsilon(1e-12));
  CHECK(lengthOf(inner.point - Point3{10, 10, 25}) < 1e-9);
  CHECK(angle->distance({23, 14, 25}) == doctest::Approx(5).epsilon(1e-12));
  CHECK(lengthOf(angle->nearest({23, 14, 25}).point - Point3{20, 10, 25}) < 1e-9);
}
