// Touches that a path shows, the parts they make, and ways that do not reach them.
#include "sim/geometry/Contact.h"
#include "tests/unit/VerifyFolder.h"

#include <cmath>
#include <doctest/doctest.h>
#include <fmt/format.h>

using namespace dotek;
using namespace dotek::tests;
using frontend::gibbs::PathMove;
using sim::Point3;
using verify::DrawnPath;
using verify::PartError;
using verify::Touch;

namespace {

constexpr double kRadius = 2;

PathMove feed(double x, double y, double z) {
  return {PathMove::Kind::Feed, x, y, z, {}};
}
PathMove alongX(double x) {
  return {PathMove::Kind::FeedX, x, 0, 0, {}};
}
PathMove alongY(double y) {
  return {PathMove::Kind::FeedY, 0, y, 0, {}};
}
PathMove alongZ(double z) {
  return {PathMove::Kind::FeedZ, 0, 0, z, {}};
}

DrawnPath drawn(const std::vector<PathMove>& moves, Point3 start = {0, 0, 60}) {
  return verify::drawnPath(moves, start, 0, kRadius);
}

// "2 +X 12 0 -3; ...": the move, the direction, the contact.
std::string touches(const DrawnPath& path) {
  std::string out;
  for (const verify::DrawnTouch& each : path.touches) {
    const Point3 &p = each.touch.point, &d = each.touch.direction;
    const char* name = d.x > 0 ? "+X" : d.x < 0 ? "-X" : d.y > 0 ? "+Y" : d.y < 0 ? "-Y" : "-Z";
    out += fmt::format("{}{} {} {} {} {}", out.empty() ? "" : "; ", each.move, name, p.x, p.y, p.z);
  }
  return out;
}

std::string why(const DrawnPath& path, const PartError& error = {}) {
  const std::vector<Touch> nominal = path.nominal();
  const auto part = verify::partOf(nominal, kRadius, kRadius, error);
  REQUIRE(part);
  const bool off = !(error.shift == Point3{}) || error.turn != 0;
  return verify::whyNotReached(path, *part, drawnProbe(kRadius), off ? verify::mostOff(nominal, error) : 0);
}

// Where the ball's centre is when it meets the part between two points.
Point3 contact(const sim::Part& part, Point3 from, Point3 to) {
  const auto touch = sim::firstContact(part, kRadius, from, to);
  REQUIRE(touch);
  CHECK_FALSE(touch->atStart);
  return touch->centre;
}

const std::vector<PathMove> kBore = {alongZ(-5), alongX(18),  alongX(-18), alongX(0),
                                     alongY(18), alongY(-18), alongY(0),   alongZ(40)};

} // namespace

TEST_CASE("drawn path: a feed along X or Y that goes back is a touch, one radius after its end") {
  CHECK(touches(drawn({alongZ(-5), alongX(10), alongX(0), alongZ(40)})) == "2 +X 12 0 -3");
  CHECK(touches(drawn({alongZ(-5), alongX(-10), alongX(0), alongZ(40)})) == "2 -X -12 0 -3");
  CHECK(touches(drawn({alongZ(-5), alongY(10), alongY(0), alongZ(40)})) == "2 +Y 0 12 -3");
  CHECK(touches(drawn({alongZ(-5), alongY(-10), alongY(0), alongZ(40)})) == "2 -Y 0 -12 -3");
  CHECK(touches(drawn({alongZ(-5), alongX(10), alongX(4), alongZ(40)})) == "2 +X 12 0 -3");
}

TEST_CASE("drawn path: X and Y count from the start, Z from the retract plane") {
  const DrawnPath path = verify::drawnPath({alongZ(-35), alongX(10), feed(0, 0, -35), feed(0, 0, 10)},
                                           {100, 50, 80}, 30, kRadius);
  CHECK(touches(path) == "2 +X 112 50 -3");
  CHECK(path.points.front() == Point3{100, 50, 80});
  CHECK(path.points.back() == Point3{100, 50, 40});
  // Before the first height is known, the probe is where it began.
  CHECK(verify::drawnPath({alongX(3)}, {1, 2, 80}, 30, kRadius).points.back() == Point3{4, 2, 80});
}

TEST_CASE("drawn path: down is a touch, up is none") {
  CHECK(touches(drawn({alongZ(10), alongZ(-5), alongZ(40)})) == "2 -Z 0 0 -5");
  CHECK(touches(drawn({alongZ(-5), alongZ(10), alongZ(-5), alongX(4), alongZ(40)})) == "1 -Z 0 0 -5");
}

TEST_CASE("drawn path: what is not taken back is no touch") {
  CHECK(touches(drawn({alongZ(-5), alongX(10), alongZ(40)})).empty());
  CHECK(touches(drawn({alongZ(-5), alongX(10), alongX(20), alongZ(40)})).empty());
  CHECK(touches(drawn({alongZ(-5), feed(10, 10, -5), feed(1, 1, -5), alongZ(40)})).empty());
  CHECK(touches(drawn({alongZ(-5), feed(10, 10, -4), feed(0, 0, -5), alongZ(40)})).empty());
  CHECK(touches(drawn({alongZ(-5), alongX(10), alongX(10), alongX(0), alongZ(40)})).empty()); // is between
  CHECK(touches(drawn({alongZ(-5), alongX(10)})).empty());
}

TEST_CASE("drawn path: a feed at an angle that goes straight back is a touch") {
  // 3, 4, 5: the contact lies the radius of 2 further along the way of 10.
  const DrawnPath path =
      drawn({alongZ(-5), feed(6, 8, -5), feed(0, 0, -5), feed(-8, 6, -5), feed(0, 0, -5), alongZ(40)});
  REQUIRE(path.touches.size() == 2);
  CHECK(path.touches[0].move == 2);
  CHECK((path.touches[0].touch.point - Point3{7.2, 9.6, -3}).length() < 1e-12);
  CHECK((path.touches[0].touch.direction - Point3{0.6, 0.8, 0}).length() < 1e-12);
  CHECK(path.touches[1].move == 4);
  CHECK((path.touches[1].touch.point - Point3{-9.6, 7.2, -3}).length() < 1e-12);
  CHECK(why(path).empty());
}

TEST_CASE("drawn path: the path back is no touch, the path on to the other side is one") {
  CHECK(touches(drawn({alongZ(-5), alongX(10), alongX(8), alongX(10), alongX(0), alongZ(40)})) ==
        "2 +X 12 0 -3; 4 +X 12 0 -3");
  CHECK(touches(drawn(kBore)) == "2 +X 20 0 -3; 3 -X -20 0 -3; 5 +Y 0 20 -3; 6 -Y 0 -20 -3");
}

TEST_CASE("parts of touches: each face lies where the ball gets to") {
  const std::vector<DrawnPath> paths = {
      drawn({alongZ(-5), alongX(10), alongX(0), alongZ(40)}),
      drawn({alongZ(-5), alongY(-10), alongY(0), alongZ(40)}),
      drawn({alongZ(10), alongZ(-5), alongZ(40)}),
      drawn(kBore, {0, 0, 90}),
      drawn({alongZ(-5), alongX(10), alongX(0), alongZ(40), feed(0, 60, 40), alongZ(-8), alongY(71.25),
             alongY(60), alongZ(40), feed(-50, 7, 40), alongZ(10), alongZ(-1), alongZ(40)}),
  };
  for (const DrawnPath& path : paths) {
    const std::vector<Touch> nominal = path.nominal();
    const auto part = verify::partOf(nominal, kRadius, kRadius, {});
    REQUIRE(part);
    for (const verify::DrawnTouch& each : path.touches) {
      CHECK(std::abs(part->distance(each.touch.point)) < 1e-9);
      CHECK(part->distance(each.touch.point + each.touch.direction * 0.5) < -0.4);
      const Point3 up{0, 0, kRadius};
      const Point3 end = path.points[each.move] + up;
      const Point3 met = contact(*part, path.points[each.move - 1] + up, end + each.touch.direction);
      CHECK(std::abs((met - end).dot(each.touch.direction)) < 1e-6);
    }
    CHECK(why(path).empty());
  }
}

TEST_CASE("parts of touches: an error moves and turns the surfaces") {
  const DrawnPath path = drawn({alongZ(-5), alongX(10), alongX(0), alongZ(40)});
  const auto moved = verify::partOf(path.nominal(), kRadius, kRadius, {{0.3, -0.2, 0.1}, 0});
  REQUIRE(moved);
  CHECK(contact(*moved, {0, 0, -3}, {12, 0, -3}).x == doctest::Approx(10.3).epsilon(1e-9));
  // Turned about the contact itself only the slant of the face shows.
  const auto slanted = verify::partOf(path.nominal(), kRadius, kRadius, {{0, 0, 0}, 0.3});
  const double angle = 0.3 * 3.14159265358979 / 180;
  CHECK(contact(*slanted, {0, 0, -3}, {12, 0, -3}).x ==
        doctest::Approx(12 - kRadius / std::cos(angle)).epsilon(1e-9));

  // Two faces 100 mm apart: each turns about the point between them.
  const DrawnPath two = drawn({alongZ(-5), alongX(10), alongX(0), alongZ(40), feed(0, 100, 40), alongZ(-5),
                               alongX(10), alongX(0), alongZ(40)});
  const PartError error{{0.1, 0, 0}, 0.2};
  const auto both = verify::partOf(two.nominal(), kRadius, kRadius, error);
  REQUIRE(both);
  const double slope = std::tan(0.2 * 3.14159265358979 / 180);
  const double first = contact(*both, {0, 0, -3}, {12, 0, -3}).x;
  const double second = contact(*both, {0, 100, -3}, {12, 100, -3}).x;
  CHECK(first - second == doctest::Approx(100 * slope).epsilon(1e-6));
  CHECK((first + second) / 2 == doctest::Approx(10.1).epsilon(1e-5));
  CHECK(verify::mostOff(two.nominal(), error) > first - 10);
  CHECK(why(two, error).empty());

  const DrawnPath down = drawn({alongZ(10), alongZ(-5), alongZ(40)});
  const auto higher = verify::partOf(down.nominal(), kRadius, kRadius, {{0.2, 0.2, 0.25}, 0.3});
  REQUIRE(higher);
  CHECK(contact(*higher, {0, 0, 12}, {0, 0, -5}).z == doctest::Approx(-4.75 + kRadius).epsilon(1e-9));
}

TEST_CASE("parts of touches: a bore, a boss, a web, and what is none of them") {
  const auto inside = [](const sim::Part& part, Point3 p) { return part.distance(p) < 0; };
  const auto made = [](const std::vector<Touch>& touches) {
    auto part = verify::partOf(touches, kRadius, kRadius, {});
    REQUIRE(part);
    return *part;
  };
  const double s = 20 / std::sqrt(2.0);
  std::vector<Touch> ring = {{{30, 0, -3}, {1, 0, 0}},
                             {{-10, 0, -3}, {-1, 0, 0}},
                             {{10, 20, -3}, {0, 1, 0}},
                             {{10, -20, -3}, {0, -1, 0}}};
  const sim::Part bore = made(ring);
  CHECK(std::abs(bore.distance({10 + s, s, -3})) < 1e-9); // a circle, not a square
  CHECK(inside(bore, {10 + s + 0.5, s, -3}));
  CHECK_FALSE(inside(bore, {10, 0, -3}));
  CHECK_FALSE(inside(bore, {35, 0, 0.1})); // 3 mm above the ball's centre it ends
  CHECK(inside(bore, {35, 0, -0.1}));
  CHECK_FALSE(inside(bore, {35, 0, -6.1}));
  // Measured from an error, its middle is the error.
  const auto off = verify::partOf(ring, kRadius, kRadius, {{0.2, -0.1, 0.3}, 0.25});
  REQUIRE(off);
  const double right = contact(*off, {10, 0, -3}, {40, 0, -3}).x,
               left = contact(*off, {10, 0, -3}, {-30, 0, -3}).x;
  CHECK((left + right) / 2 == doctest::Approx(10.2).epsilon(1e-9));

  for (Touch& touch : ring)
    touch.direction = touch.direction * -1;
  const sim::Part boss = made(ring);
  CHECK(inside(boss, {10, 0, -3}));
  CHECK(std::abs(boss.distance({10 + s, s, -3})) < 1e-9);

  // A boss whose top is touched ends there, and nothing beside it is in the way of its sides.
  std::vector<Touch> topped = ring;
  topped.push_back({{10, 0, -1}, {0, 0, -1}});
  const sim::Part spigot = made(topped);
  CHECK(std::abs(spigot.distance({10, 0, -1})) < 1e-9);
  CHECK_FALSE(inside(spigot, {10, 0, -0.9}));
  CHECK_FALSE(inside(spigot, {31, 0, -3}));

  // Two bores are in one plate: that of one does not close the other.
  std::vector<Touch> pair;
  for (const Touch& touch : ring)
    for (const double away : {0.0, 45.0})
      pair.push_back({{touch.point.x + away, touch.point.y, touch.point.z}, touch.direction * -1});
  const sim::Part bores = made(pair);
  CHECK_FALSE(inside(bores, {10, 0, -3}));
  CHECK_FALSE(inside(bores, {55, 0, -3}));
  CHECK_FALSE(inside(bores, {29, 0, -3}));
  CHECK(inside(bores, {32, 0, -3}));

  // Three touches at angles look from one middle: a bore, a boss where they look to it. Over other distances
  // each has its own face, and so have three along the axes.
  const auto around = [](double first, double second, double third, double length, double sign) {
    std::vector<Touch> out;
    for (const double degrees : {first, second, third}) {
      const double angle = degrees * 3.14159265358979323846 / 180, way = out.size() == 2 ? length : 20;
      const Point3 to{std::cos(angle), std::sin(angle), 0};
      out.push_back({Point3{5, 7, -3} + to * way, to * sign});
    }
    return out;
  };
  const sim::Part arc = made(around(30, 75, 160, 20, 1));
  CHECK(std::abs(arc.distance({5, 7 - 20, -3})) < 1e-6);
  CHECK_FALSE(inside(arc, {5, 7, -3}));
  CHECK(inside(arc, {5, 7 - 20.5, -3}));
  const sim::Part stud = made(around(-10, 130, 250, 20, -1));
  CHECK(std::abs(stud.distance({5 + 20, 7, -3})) < 1e-6);
  CHECK(inside(stud, {5, 7, -3}));
  CHECK_FALSE(inside(made(around(30, 75, 160, 21, 1)), {5, 7 - 20.5, -3}));
  CHECK_FALSE(inside(made(around(0, 90, 180, 20, 1)), {5, 7 - 20.5, -3}));

  // A web is solid between its faces, which may be nearer than a search goes.
  const sim::Part web = made({{{1, 0, -3}, {-1, 0, 0}}, {{0, 0, -3}, {1, 0, 0}}});
  CHECK(inside(web, {0.5, 0, -3}));
  CHECK_FALSE(inside(web, {1.1, 0, -3}));
  CHECK_FALSE(inside(web, {-0.1, 0, -3}));
  // A rectangular pocket has a face for each touch and nothing in its corners.
  const sim::Part pocket = made({{{30, 0, -3}, {1, 0, 0}},
                                 {{-30, 0, -3}, {-1, 0, 0}},
                                 {{0, 20, -3}, {0, 1, 0}},
                                 {{0, -20, -3}, {0, -1, 0}}});
  CHECK(inside(pocket, {30.5, 0, -3}));
  CHECK(inside(pocket, {0, -20.5, -3}));
  CHECK_FALSE(inside(pocket, {30.5, 19, -3}));
  CHECK_FALSE(inside(pocket, {20, 15, -3}));

  CHECK_FALSE(verify::partOf({}, kRadius, kRadius, {}));
}

TEST_CASE("ways that do not reach: each has its reason") {
  // The touch of the first move is in the path of the third.
  CHECK(why(drawn({alongZ(-5), alongX(10), alongX(0), alongZ(40), feed(13, 0, 40), alongZ(-5), alongY(20),
                   alongY(0), alongZ(40)})) == "move 6 runs into the part at X13.000 Y0.000 Z0.000");
  CHECK(why(drawn({alongZ(10), alongZ(-5), alongZ(8)})) == "the path ends lower than it was");
  // Two faces back to back at one place.
  CHECK(why(drawn({alongZ(-5), alongX(10), alongX(0), alongZ(40), feed(30, 0, 40), alongZ(-5), alongX(14),
                   alongX(30), alongZ(40)})) == "move 2 touches at X6.000 Y0.000 Z-5.000, not where it ends");
  // Below the first face, and after it.
  CHECK(why(drawn({alongZ(-5), alongX(10), alongX(0), alongZ(40), feed(30, 0, 40), alongZ(-40), alongX(14),
                   alongX(30), alongZ(40)})) == "the stem runs into the part in move 7");
  CHECK(why(drawn({alongZ(-5), alongX(10), alongX(0), alongZ(40), feed(30, 0, 40), alongZ(-70), alongX(24),
                   alongX(30), alongZ(40)})) == "the probe's body runs into the part in move 6");

  const DrawnPath path = drawn({alongZ(-5), alongX(10), alongX(0), alongZ(40)});
  const auto elsewhere = verify::partOf(path.nominal(), kRadius, kRadius, {{0.5, 0, 0}, 0});
  REQUIRE(elsewhere);
  CHECK(verify::whyNotReached(path, *elsewhere, drawnProbe(kRadius)) ==
        "move 2 does not reach the surface it touches");
  CHECK(verify::whyNotReached(path, *elsewhere, drawnProbe(kRadius), 0.5).empty());
  const DrawnPath low = drawn({alongX(10), alongX(0), alongZ(40)}, {0, 0, -5});
  const auto early = verify::partOf(low.nominal(), kRadius, kRadius, {{-11, 0, 0}, 0});
  REQUIRE(early);
  CHECK(verify::whyNotReached(low, *early, drawnProbe(kRadius), 11.1) == "move 1 touches where it begins");
  CHECK(verify::whyNotReached(drawn({alongZ(-5), alongZ(-9)}), *elsewhere, drawnProbe(kRadius)) ==
        "the path shows no touch; draw the move to each surface and the one back in ToolPath.mac: the part "
        "is made "
        "from them");
}
