// Contacts that a pencil can check.
#include "tests/Draws.h"
#include "tests/unit/PartHelper.h"

#include <doctest/doctest.h>

using namespace dotek::sim;
using namespace dotek::tests;
using Action = PartBuilder::Action;

namespace {

constexpr double kExact = 1e-8; // mm

// A plate with a bore of 38 mm at (50, 30), from above.
std::unique_ptr<Part> plate() {
  PartBuilder builder;
  builder.box({0, 0, -20}, {100, 60, 0});
  builder.cylinder({50, 30, -20}, {50, 30, 0}, 19, Action::Remove);
  return finish(builder);
}

// Where along the path the ball stops, in mm; negative: nowhere.
double way(const Part& part, double radius, const Point3& from, const Point3& to) {
  const auto touch = firstContact(part, radius, from, to);
  return touch ? touch->share * lengthOf(to - from) : -1;
}

bool isNear(double a, double b, double within = kExact) {
  return std::abs(a - b) <= within;
}

} // namespace

TEST_CASE("part: faces stop a ball at its radius") {
  const auto part = plate();
  const auto touch = firstContact(*part, 3, {-20, 30, -5}, {20, 30, -5});
  REQUIRE(touch);
  CHECK(isNear(touch->centre.x, -3));
  CHECK(lengthOf(touch->point - Point3{0, 30, -5}) < kExact);
  CHECK(lengthOf(touch->normal - Point3{-1, 0, 0}) < kExact);
  CHECK(isNear(way(*part, 3, {10, 10, 50}, {10, 10, -5}), 47));
  // Slantwise: the path is longer by the cosine.
  CHECK(isNear(way(*part, 3, {-20, 30, -5}, {0, 50, -5}), 17 * std::sqrt(2)));
  CHECK(way(*part, 3, {-20, 30, -5}, {-3.001, 30, -5}) < 0);

  PartBuilder builder;
  builder.halfSpace({10, 0, 0}, {1, 1, 0});
  const auto wall = finish(builder);
  CHECK(isNear(way(*wall, 2, {60, 0, 0}, {-60, 0, 0}), 50 - 2 * std::sqrt(2)));
}

TEST_CASE("part: a bore and a boss are round from every side") {
  const auto part = plate();
  PartBuilder builder;
  builder.cylinder({50, 30, -20}, {50, 30, 0}, 19);
  const auto boss = finish(builder);
  for (int n = 0; n < 32; ++n) {
    const double a = n * 2 * M_PI / 32;
    const Point3 centre{50, 30, -8}, out{40 * std::cos(a), 40 * std::sin(a), 0};
    CHECK(isNear(way(*part, 3, centre, centre + out), 16));
    CHECK(isNear(way(*boss, 3, centre + out, centre), 18));
  }
  // Out of the middle, the wall is met by Pythagoras.
  CHECK(isNear(way(*part, 3, {50, 38, -8}, {100, 38, -8}), std::sqrt(16 * 16 - 8 * 8)));
}

TEST_CASE("part: edges and corners are met where they are, not where their faces would be") {
  const auto part = plate();
  // The rim of the bore, 1 mm off the ball's middle.
  CHECK(isNear(way(*part, 3, {70, 30, 40}, {70, 30, -10}), 40 - 3)); // face
  CHECK(isNear(way(*part, 3, {68, 30, 40}, {68, 30, -10}), 40 - std::sqrt(9 - 1)));
  // An edge of the plate, and a corner.
  CHECK(isNear(way(*part, 3, {-2, 30, 40}, {-2, 30, -10}), 40 - std::sqrt(9 - 4)));
  CHECK(isNear(way(*part, 3, {-1, -1, 40}, {-1, -1, -10}), 40 - std::sqrt(9 - 2)));
  const double d = 10;
  CHECK(isNear(way(*part, 3, {-d, -d, d}, {d, d, -d}), d * std::sqrt(3) - 3));
  // A ball wider than a slot sits on both edges.
  PartBuilder builder;
  builder.box({-50, -50, -20}, {50, 50, 0});
  builder.box({-4, -60, -10}, {4, 60, 0}, Action::Remove);
  const auto slot = finish(builder);
  CHECK(isNear(way(*slot, 5, {0, 0, 20}, {0, 0, -20}), 20 - 3));
  CHECK(isNear(slot->distance({0, 0, 1}), std::sqrt(17)));
}

TEST_CASE("part: cones, spheres, slots and pockets") {
  PartBuilder builder;
  builder.cone({0, 0, 0}, 10, {0, 0, 20}, 0);
  const auto cone = finish(builder);
  // Its side leans by atan(1/2): at height z the axis is (20 - z) / 2 + r / cos away.
  const double slope = std::sqrt(1.25);
  CHECK(isNear(way(*cone, 2, {40, 0, 8}, {0, 0, 8}), 40 - (6 + 2 * slope)));
  CHECK(isNear(way(*cone, 2, {0, 0, 40}, {0, 0, 10}), 18)); // its point
  CHECK(isNear(cone->distance({0, 0, 23}), 3));

  PartBuilder ball;
  ball.sphere({1, 2, 3}, 5);
  ball.box({1, -9, -9}, {9, 9, 9}, Action::Remove); // half of it
  const auto half = finish(ball);
  CHECK(isNear(way(*half, 2, {-30, 2, 3}, {0, 2, 3}), 31 - 7));
  CHECK(isNear(way(*half, 2, {30, 2, 3}, {0, 2, 3}), 29 - 2));
  CHECK(isNear(way(*half, 2, {30, 8, 3}, {-10, 8, 3}), 29 - std::sqrt(3.0))); // the rim, 1 mm off

  PartBuilder pocket;
  pocket.box({-40, -40, -20}, {40, 40, 0});
  pocket.block({0, 0, -5}, {0, 0, -1}, {1, 0, 0}, {20, 10, 5}, 6, Action::Remove);
  const auto part = finish(pocket);
  CHECK(isNear(way(*part, 3, {0, 0, -5}, {40, 0, -5}), 17));
  CHECK(isNear(way(*part, 3, {0, 0, -5}, {0, -40, -5}), 7));
  CHECK(isNear(way(*part, 3, {14, 4, -5}, {34, 24, -5}), 3)); // into a corner of radius 6
  CHECK(isNear(way(*part, 3, {0, 0, 30}, {0, 0, -15}), 37));  // its floor, through the open mouth
}

TEST_CASE("part: a mouth in a face is open, and two pieces that touch are one") {
  PartBuilder builder;
  builder.box({0, 0, -20}, {100, 60, 0});
  builder.box({0.1 + 0.2, 10, -5}, {90, 50, 0}, Action::Remove);
  const auto part = finish(builder);
  CHECK(isNear(part->distance({50, 30, 3}), 8)); // the floor, not the mouth
  CHECK(isNear(way(*part, 3, {50, 30, 40}, {50, 30, -10}), 42));
  // Turned, the faces coincide to the last digits only.
  const Part turned = part->placed({{3, 5, 7}, {10, 20, 30}});
  const Point3 from = turned.toMachine({50, 30, 40}), to = turned.toMachine({50, 30, -10});
  CHECK(isNear(way(turned, 3, from, to), 42));

  PartBuilder two;
  two.box({0, 0, 0}, {10, 10, 10});
  two.box({10, 0, 0}, {20, 10, 10});
  const auto joined = finish(two);
  CHECK(isNear(joined->distance({10, 5, 6}), -4));
  CHECK(isNear(way(*joined, 2, {10, 5, 30}, {10, 5, 0}), 18));
}

TEST_CASE("part: the edge of a cross hole") {
  PartBuilder builder;
  builder.cylinder({0, 0, -40}, {0, 0, 40}, 20);
  builder.cylinder({-30, 0, 0}, {30, 0, 0}, 8, Action::Remove);
  const auto part = finish(builder);
  PartRandom random(5);
  for (int n = 0; n < 40; ++n) {
    // In front of the hole, where only its edge is near.
    const Point3 p{random.between(20, 24), random.between(-4, 4), random.between(-4, 4)};
    double least = 1e9;
    for (int k = 0; k < 400'000; ++k) {
      const double a = k * 2 * M_PI / 400'000, y = 8 * std::cos(a), z = 8 * std::sin(a);
      least = std::min(least, lengthOf(p - Point3{std::sqrt(400 - y * y), y, z}));
    }
    CHECK(isNear(part->distance(p), least, 1e-7));
  }
  // Equal diameters: two edges cross.
  PartBuilder equal;
  equal.cylinder({0, 0, -40}, {0, 0, 40}, 20);
  equal.cylinder({-50, 0, 0}, {50, 0, 0}, 20, Action::Remove);
  const auto crossed = finish(equal);
  CHECK(isNear(crossed->distance({0, 25, 0}), 5, 1e-6));
  // Above the saddle, in the plane of both axes' normals: the edge x = z, y^2 = 400 - x^2.
  double least = 1e9;
  for (int k = 0; k < 400'000; ++k) {
    const double a = k * 2 * M_PI / 400'000, x = 20 * std::cos(a);
    least = std::min({least, lengthOf(Point3{0.5, 23, 0.2} - Point3{x, 20 * std::sin(a), x}),
                      lengthOf(Point3{0.5, 23, 0.2} - Point3{x, 20 * std::sin(a), -x})});
  }
  CHECK(isNear(crossed->distance({0.5, 23, 0.2}), least, 1e-6));
}

TEST_CASE("part: no wall is too thin, no path too long") {
  for (const double wall : {1.0, 0.01, 0.001}) {
    PartBuilder builder;
    builder.box({0, -50, -50}, {wall, 50, 50});
    const auto part = finish(builder);
    for (const double length : {10.0, 1000.0, 10000.0})
      CHECK(isNear(way(*part, 0.005, {-length / 3, 1, 2}, {length, 1, 2}), length / 3 - 0.005, 1e-7));
  }
}

TEST_CASE("part: a graze is reported from a miss") {
  const auto part = plate();
  for (const double gap : {1e-3, 1e-5, 1e-6}) {
    INFO("gap " << gap);
    CHECK(way(*part, 3, {-50, 5, 3 + gap}, {150, 5, 3 + gap}) < 0);
    CHECK(way(*part, 3, {-50, 5, 3 - gap}, {150, 5, 3 - gap}) > 0);
  }
  PartBuilder builder;
  builder.sphere({0, 0, 0}, 10);
  const auto ball = finish(builder);
  CHECK(way(*ball, 2, {-50, 12.0001, 0}, {50, 12.0001, 0}) < 0);
  CHECK(
      isNear(way(*ball, 2, {-50, 11.999, 0}, {50, 11.999, 0}), 50 - std::sqrt(144 - 11.999 * 11.999), 1e-6));
}

TEST_CASE("part: where a path begins to slide along a face does not depend on its start") {
  constexpr double kRadius = 1.196;
  PartBuilder builder;
  builder.box({10, 0, -20}, {50, 100, 0});
  const auto part = finish(builder);
  const double beside = 10 - kRadius;
  const auto meets = [&](double from, double to) {
    const auto touch = firstContact(*part, kRadius, {beside, from, -5}, {beside, to, -5});
    REQUIRE(touch);
    return touch->centre.y;
  };
  // The ball comes nearer by the square of the way: 1e-10 mm of air are some 15 nm of it.
  const double place = meets(-50, 8.8);
  CHECK(isNear(place, 0, 3e-5));
  for (const double from : {-0.5, -0.486493, -1.234567, -3.0, -7.77, -20.0001, -49.97})
    for (const double to : {0.5, 1.0, 9.999, 60.0})
      CHECK(isNear(meets(from, to), place, 2e-7));
}

TEST_CASE("part: a start in contact") {
  const auto part = plate();
  const auto touch = firstContact(*part, 3, {-2.9, 30, -5}, {5, 30, -5});
  REQUIRE(touch);
  CHECK(touch->atStart);
  CHECK(touch->share == 0);
  CHECK(!firstContact(*part, 3, {-2.9, 30, -5}, {-10, 30, -5}));  // away
  CHECK(firstContact(*part, 3, {-2.9, 30, -5}, {-2.9, 35, -5}));  // along
  CHECK(firstContact(*part, 3, {-2.9, 30, -5}, {-2.9, 30, -5}));  // stays
  CHECK(!firstContact(*part, 3, {-3.1, 30, -5}, {-3.1, 30, -5})); // stays free
  CHECK(!firstContact(*part, 3, {50, 46.2, -5}, {50, 30, -5}));   // off the wall of the bore
  const auto across = firstContact(*part, 3, {50, 46.2, -5}, {50, 0, -5});
  REQUIRE(across);
  CHECK(!across->atStart);
  CHECK(isNear(across->centre.y, 14));
  // A retract from deep inside is no contact, either.
  CHECK(!firstContact(*part, 3, {10, 30, -1}, {10, 30, 40}));
}

TEST_CASE("part: capsules") {
  const auto part = plate();
  const Capsule stem{{-20, 30, -10}, {-20, 30, 30}, 2};
  const auto side = firstCollision(*part, stem, {40, 0, 0});
  REQUIRE(side);
  CHECK(isNear(*side * 40, 18, 2e-3));
  // Along a wall, and along its own axis.
  CHECK(!firstCollision(*part, {{-2.01, 30, -10}, {-2.01, 30, 30}, 2}, {0, 20, 0}));
  CHECK(!firstCollision(*part, {{50, 30, 10}, {50, 30, 60}, 18.9}, {0, 0, -60}));
  const auto down = firstCollision(*part, {{50, 30, 10}, {50, 30, 60}, 20}, {0, 0, -60});
  REQUIRE(down);
  CHECK(isNear(*down * 60, 10 - std::sqrt(20 * 20 - 19 * 19), 2e-3));
  // Over an edge, leaning.
  CHECK(firstCollision(*part, {{110, 30, -10}, {130, 30, 10}, 1}, {-20, 0, 0}));
  CHECK(firstCollision(*part, {{10, 10, -1}, {10, 10, 5}, 1}, {0, 0, 0}) == 0);
  CHECK(!firstCollision(*part, {{10, 10, 3}, {10, 10, 5}, 1}, {0, 0, 0}));
  // Thin wall, long way.
  PartBuilder builder;
  builder.box({0, -50, -50}, {0.001, 50, 50});
  CHECK(firstCollision(*finish(builder), {{-900, 0, 0}, {-900, 0, 60}, 1}, {2000, 0, 0}));
}

TEST_CASE("part: what makes no solid is refused") {
  const auto fault = [](const std::function<void(PartBuilder&)>& fill) {
    PartBuilder builder;
    fill(builder);
    std::string out;
    CHECK(builder.finish(out) == nullptr);
    return out;
  };
  CHECK(fault([](PartBuilder&) {}) == "the part has no shape");
  CHECK(fault([](PartBuilder& b) { b.box({0, 0, 0}, {1, 1, 0}); }) == "a box has a side below 0.001 mm");
  CHECK(fault([](PartBuilder& b) { b.box({0, 0, 0}, {1, 1, NAN}); }) == "a box reaches beyond 20000 mm");
  CHECK(fault([](PartBuilder& b) {
          b.box({0, 0, 0}, {4, 4, 4}, Action::Add, 2.1);
        }) == "the corners of a box are rounder than its sides are wide");
  CHECK(fault([](PartBuilder& b) {
          b.cylinder({0, 0, 0}, {0, 0, 0}, 3);
        }) == "a cylinder has a size below 0.001 mm");
  CHECK(fault([](PartBuilder& b) {
          b.cone({0, 0, 0}, 3, {0, 0, 1}, 3 + 1e-8);
        }) == "a cone has almost the angle of a cylinder or of a plane");
  CHECK(fault([](PartBuilder& b) {
          b.cone({0, 0, 0}, 0, {0, 0, 1}, -3);
        }) == "a cone has a size below 0.001 mm");
  CHECK(fault([](PartBuilder& b) { b.sphere({0, 0, 0}, 0); }) == "a sphere is smaller than 0.001 mm");
  CHECK(fault([](PartBuilder& b) { b.halfSpace({0, 0, 0}, {0, 0, 0}); }) == "a half-space has no normal");
  CHECK(fault([](PartBuilder& b) {
          b.sphere({0, 0, 0}, 1, Action::Remove);
        }) == "the first shape of a list removes or keeps, and nothing is there yet");
  CHECK(fault([](PartBuilder& b) {
          b.sphere({0, 0, 0}, 1);
          b.sphere({0, 0, 0}, 2, Action::Remove);
        }) == "nothing is left of the part");
  CHECK(fault([](PartBuilder& b) {
          b.sphere({0, 0, 0}, 1);
          b.sphere({9, 0, 0}, 2, Action::Keep);
        }) == "nothing is left of the part");
  CHECK(fault([](PartBuilder& b) {
          for (int n = 0; n < 300; ++n)
            b.sphere({n * 3.0, 0, 0}, 1);
        }) == "the part has more than 200 shapes");
  // All of them cross: bounded work, not hours.
  CHECK(fault([](PartBuilder& b) {
          if (fewDraws()) b.limitWork(1e6); // the whole limit takes 7 s, under the sanitizers 15 minutes
          PartRandom random(9);
          for (int n = 0; n < 190; ++n)
            b.cylinder(random.direction() * -40, random.direction() * 40, 10);
        }) ==
        "too many of its shapes cross each other, or two surfaces touch in a path that cannot be followed");
}
