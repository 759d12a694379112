#include "sim/picture/Lattice.h"
#include "sim/picture/PicturePlanes.h"
#include "sim/picture/Sections.h"
#include "sim/picture/SurfaceMesh.h"
#include "tests/Draws.h"
#include "tests/unit/PictureHelper.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <fmt/format.h>
#include <map>
#include <numbers>

using namespace dotek::sim;
using namespace dotek::tests;
using Action = PartBuilder::Action;

namespace {

double distanceTo(const PlanePoint& p, const PlanePoint& a, const PlanePoint& b) {
  const double dx = b[0] - a[0], dy = b[1] - a[1], square = dx * dx + dy * dy;
  const double t = square > 0 ? std::clamp(((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / square, 0.0, 1.0) : 0;
  return std::hypot(p[0] - a[0] - dx * t, p[1] - a[1] - dy * t);
}

double distanceTo(const PlanePoint& p, const SectionLine& line) {
  double best = 1e9;
  const std::size_t count = line.points.size();
  for (std::size_t i = 0; i + (line.closed ? 0 : 1) < count; ++i)
    best = std::min(best, distanceTo(p, line.points[i], line.points[(i + 1) % count]));
  return best;
}

// Positive where it runs counterclockwise.
double areaOf(const SectionLine& line) {
  double out = 0;
  for (std::size_t i = 0; i < line.points.size(); ++i) {
    const PlanePoint &a = line.points[i], &b = line.points[(i + 1) % line.points.size()];
    out += (a[0] * b[1] - b[0] * a[1]) / 2;
  }
  return out;
}

bool isWithin(const PlanePoint& p, const Section& section) {
  bool in = false;
  for (const SectionLine& line : section.areas) {
    for (std::size_t i = 0; i < line.points.size(); ++i) {
      const PlanePoint &a = line.points[i], &b = line.points[(i + 1) % line.points.size()];
      if ((a[1] > p[1]) != (b[1] > p[1]) && p[0] < a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]))
        in = !in;
    }
  }
  return in;
}

Point3 atPlane(std::size_t across, double at, const PlanePoint& p) {
  Point3 out;
  setCoordinate(out, across, at);
  setCoordinate(out, planeAxes(across)[0], p[0]);
  setCoordinate(out, planeAxes(across)[1], p[1]);
  return out;
}

double volumeOf(const SurfaceMesh& mesh) {
  double out = 0;
  for (const auto& t : mesh.triangles) {
    const Point3 &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    out +=
        (a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) + a.z * (b.x * c.y - b.y * c.x)) / 6;
  }
  return out;
}

// Edges with more triangles on one side than on the other.
std::size_t openEdges(const SurfaceMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
  for (const auto& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = t[i], b = t[(i + 1) % 3];
      sides[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
    }
  }
  return static_cast<std::size_t>(
      std::count_if(sides.begin(), sides.end(), [](const auto& s) { return s.second != 0; }));
}

} // namespace

TEST_CASE("section: of a turned box it is its outline") {
  PartBuilder builder;
  builder.box({0, 0, -20}, {120, 80, 0});
  const Part part = finish(builder)->placed({{10, 20, 30}, {}}, {{0, 0, 0}, {0, 0, 17}});
  const Section section = sectionOf(part, 2, 20, {{-60, -20, -10}, {160, 180, 60}});
  REQUIRE(section.areas.size() == 1);
  REQUIRE(section.lines.size() == 1);
  CHECK(section.lines[0].closed);
  CHECK(areaOf(section.areas[0]) == doctest::Approx(120 * 80).epsilon(1e-4));
  CHECK(section.lines[0].points.size() < 40);
  for (const PlanePoint& p : section.lines[0].points)
    CHECK(std::abs(part.distance(atPlane(2, 20, p))) < 0.05);
  // Every place of the outline, the corners too, is near the line.
  const Point3 corners[] = {{0, 0, 0}, {120, 0, 0}, {120, 80, 0}, {0, 80, 0}};
  for (int i = 0; i < 4; ++i) {
    for (double share = 0; share < 1; share += 1.0 / 64) {
      const Point3 p = part.toMachine(corners[i] + (corners[(i + 1) % 4] - corners[i]) * share);
      CAPTURE(i);
      CAPTURE(share);
      CHECK(distanceTo({p.x, p.y}, section.lines[0]) < 0.05);
    }
  }
}

TEST_CASE("section: a bore is a hole, across and along") {
  const Part part = platePart();
  const Region region{{-320, -220, -430}, {-160, -100, -370}};
  const Section across = sectionOf(part, 2, -410, region);
  REQUIRE(across.areas.size() == 2);
  CHECK(areaOf(across.areas[0]) * areaOf(across.areas[1]) < 0);
  const SectionLine& bore = areaOf(across.areas[0]) < 0 ? across.areas[0] : across.areas[1];
  const Point3 centre = part.toMachine({30, 40, -10});
  for (std::size_t i = 0; i < bore.points.size(); ++i) {
    const PlanePoint &a = bore.points[i], &b = bore.points[(i + 1) % bore.points.size()];
    CHECK(std::hypot(a[0] - centre.x, a[1] - centre.y) == doctest::Approx(15).epsilon(0.05 / 15));
    CHECK(std::hypot((a[0] + b[0]) / 2 - centre.x, (a[1] + b[1]) / 2 - centre.y) ==
          doctest::Approx(15).epsilon(0.05 / 15));
  }
  CHECK(areaOf(bore) == doctest::Approx(-225 * std::numbers::pi).epsilon(0.002));
  const Section along = sectionOf(part, 1, centre.y, region);
  CHECK(along.areas.size() == 2);
}

TEST_CASE("section: what the region cuts is closed, and its border is no line of the part") {
  PartBuilder builder;
  builder.halfSpace({0, 0, 0}, {0, 0, 1});
  const auto part = finish(builder);
  const Region region{{-50, -50, -50}, {50, 50, 50}};
  const Section side = sectionOf(*part, 1, 0, region);
  REQUIRE(side.areas.size() == 1);
  CHECK(areaOf(side.areas[0]) == doctest::Approx(100 * 50).epsilon(1e-5));
  REQUIRE(side.lines.size() == 1);
  CHECK_FALSE(side.lines[0].closed);
  for (const PlanePoint& p : side.lines[0].points)
    CHECK(std::abs(p[1]) < 0.01);
  const Section below = sectionOf(*part, 2, -10, region);
  REQUIRE(below.areas.size() == 1);
  CHECK(areaOf(below.areas[0]) == doctest::Approx(1e4).epsilon(1e-5));
  CHECK(below.lines.empty());
  CHECK(sectionOf(*part, 2, 10, region).areas.empty());
  // Within a face rounding decides nothing: it is all material.
  CHECK(sectionOf(*part, 2, 0, region).areas.size() == 1);
}

TEST_CASE("section: random parts, held against what their shapes contain") {
  int compared = 0, within = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const RandomPart random = RandomPart::make(seed);
    PartRandom dice(seed);
    const std::size_t across = dice.below(3);
    const double at = dice.between(-6, 6);
    const Section section = sectionOf(*random.part, across, at, {{-40, -40, -40}, {40, 40, 40}});
    for (int i = 0; i < 300; ++i) {
      const PlanePoint p{dice.between(-14, 14), dice.between(-14, 14)};
      const Point3 q = atPlane(across, at, p);
      if (std::abs(random.part->distance(q)) < 0.5) continue; // a cell's diagonal
      CAPTURE(seed);
      CAPTURE(p[0]);
      CAPTURE(p[1]);
      CHECK(isWithin(p, section) == random.contains(q));
      ++compared;
      within += random.contains(q) ? 1 : 0;
    }
    for (const SectionLine& line : section.lines) {
      for (const PlanePoint& p : line.points)
        CHECK(std::abs(random.part->distance(atPlane(across, at, p))) < 0.05);
    }
  }
  CHECK(compared > 4000);
  CHECK(within > 500);
}

TEST_CASE("surface: a plate with a bore is closed, of the right size, with its edges") {
  PartBuilder builder;
  builder.box({0, 0, -20}, {120, 80, 0});
  builder.cylinder({30, 40, -30}, {30, 40, 1}, 15, Action::Remove);
  const auto part = finish(builder);
  const SurfaceMesh mesh = surfaceOf(*part, {{-7.3, -8.1, -29.7}, {130.2, 91, 14}});
  REQUIRE(mesh.triangles.size() > 1000);
  CHECK(openEdges(mesh) == 0);
  CHECK(volumeOf(mesh) == doctest::Approx(120 * 80 * 20 - 225 * std::numbers::pi * 20).epsilon(0.005));
  for (const Point3& p : mesh.vertices)
    CHECK(std::abs(part->distance(p)) < 0.25);
  for (const Point3& corner : {Point3{0, 0, 0}, {120, 0, 0}, {0, 80, -20}, {120, 80, -20}}) {
    const bool there = std::any_of(mesh.vertices.begin(), mesh.vertices.end(),
                                   [&](const Point3& p) { return lengthOf(p - corner) < 0.01; });
    CHECK(there);
  }
  // No triangle covers the bore.
  for (const auto& t : mesh.triangles) {
    const Point3 middle = (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) * (1.0 / 3);
    CHECK(std::hypot(middle.x - 30, middle.y - 40) > 14);
  }
}

TEST_CASE("surface: open where the region ends, with no face that the part does not have") {
  PartBuilder builder;
  builder.halfSpace({0, 0, 0}, {0, 0, 1});
  const auto part = finish(builder);
  const SurfaceMesh mesh = surfaceOf(*part, {{-50, -40, -30}, {50, 40, 30}});
  REQUIRE(mesh.triangles.size() > 1000);
  CHECK(openEdges(mesh) > 100);
  for (const Point3& p : mesh.vertices)
    CHECK(std::abs(p.z) < 0.01);
  CHECK(surfaceOf(*part, {{-50, -40, 10}, {50, 40, 30}}).triangles.empty());
}

TEST_CASE("surface: of random parts it is closed, and their size") {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const RandomPart random = RandomPart::make(seed);
    const SurfaceMesh mesh = surfaceOf(*random.part, {{-46, -46, -46}, {46, 46, 46}});
    CAPTURE(seed);
    CHECK(openEdges(mesh) == 0);
    PartRandom dice(seed);
    int in = 0;
    constexpr int kPoints = 40'000;
    constexpr double kReach = 45; // nothing of such a part is farther out
    for (int i = 0; i < kPoints; ++i)
      in += random.contains(dice.point(kReach)) ? 1 : 0;
    const double volume = std::pow(2 * kReach, 3) * in / kPoints,
                 deviation = std::pow(2 * kReach, 3) * std::sqrt(in + 1.0) / kPoints;
    CHECK(std::abs(volumeOf(mesh) - volume) < 4 * deviation + 0.03 * volume);
  }
}

// 31 bores of 4 to 10 mm and a slot in one corner of a plate of 2 m.
std::unique_ptr<Part> largePlate(double& removed) {
  PartBuilder builder;
  builder.box({0, 0, -20}, {2000, 300, 0});
  removed = 0;
  for (int i = 0; i < 30; ++i) {
    const double x = 15 + 17 * (i % 6), y = 20 + 30 * (i / 6), radius = 2 + i % 4;
    builder.cylinder({x, y, -10}, {x, y, 1}, radius, Action::Remove);
    removed += std::numbers::pi * radius * radius;
  }
  builder.cylinder({1900, 250, -30}, {1900, 250, 1}, 4, Action::Remove);
  builder.block({1500, 150, -5}, {0, 0, 1}, {1, 1, 0}, {60, 2, 6}, 2, Action::Remove);
  removed += 16 * std::numbers::pi + 2 * 60 * 2 * 2 - (4 - std::numbers::pi) * 4;
  return finish(builder);
}

TEST_CASE("sections and surface: small bores of a large plate are drawn, each for itself") {
  double removed = 0;
  const auto part = largePlate(removed);
  const Region region{{-60, -60, -80}, {2060, 360, 120}};
  const Section section = sectionOf(*part, 2, -5, region);
  REQUIRE(section.areas.size() == 33);
  double area = 0;
  for (const SectionLine& line : section.areas)
    area += areaOf(line);
  CHECK(area == doctest::Approx(2000 * 300 - removed).epsilon(1e-4));
  for (const SectionLine& line : section.areas)
    for (const PlanePoint& p : line.points)
      CHECK(std::abs(part->distance({p[0], p[1], -5})) < 0.2);
  CHECK(sectionOf(*part, 1, 20, region).areas.size() == 1);
  CHECK(sectionLattice(*part, 2, -5, region).missed == 0);

  if (fewDraws()) return; // the surface takes minutes there; those of smaller parts are made elsewhere
  const SurfaceMesh mesh = surfaceOf(*part, region, 160);
  CHECK(mesh.missed == 0);
  CHECK(openEdges(mesh) == 0);
  CHECK(mesh.triangles.size() < 400'000);
  for (int i = 0; i < 30; ++i) {
    const double x = 15 + 17 * (i % 6), y = 20 + 30 * (i / 6), radius = 2 + i % 4;
    const auto onWall = std::count_if(mesh.vertices.begin(), mesh.vertices.end(), [&](const Point3& p) {
      return std::abs(std::hypot(p.x - x, p.y - y) - radius) < 0.1 && p.z > -9.9 && p.z < -0.1;
    });
    CAPTURE(i);
    CHECK(onWall >= 12);
  }
}

TEST_CASE("sections and surface: what is too fine for a picture is said") {
  PartBuilder builder;
  builder.box({0, 0, -20}, {2000, 2000, 0});
  for (int i = 0; i < 180; ++i)
    builder.cylinder({20 + 11.0 * i, 20 + std::fmod(i * 733.0, 1950), -10},
                     {20 + 11.0 * i, 20 + std::fmod(i * 733.0, 1950), 1}, 0.2, Action::Remove);
  const auto part = finish(builder);
  const Region region{{-10, -10, -30}, {2010, 2010, 30}};
  if (!fewDraws()) CHECK(surfaceOf(*part, region, 160).missed == doctest::Approx(0.4));
  CHECK(sectionLattice(*part, 2, -5, region).missed == doctest::Approx(0.4));
  CHECK(sectionLattice(*part, 2, -15, region).missed == 0); // under the bores
  CHECK(missedNote(0.4).find("0.4 mm") != std::string::npos);
  CHECK(missedNote(0).empty());
}

TEST_CASE("picture region: the reach of a part, and what a far rapid does not widen") {
  const Region reach = reachOf(platePart());
  CHECK(reach.most.x - reach.least.x == doctest::Approx(120.35).epsilon(1e-3));
  CHECK(reach.most.z == doctest::Approx(-400 + 12 + 0.03).epsilon(1e-4));
  PartBuilder builder;
  builder.halfSpace({0, 0, 0}, {0, 0, 1});
  CHECK(reachOf(*finish(builder)).most.x > 1e4);

  Picture picture = borePicture();
  const Region region = regionOf(picture);
  CHECK(region.contains({-270, -160, -377}));
  CHECK_FALSE(region.contains({-270, -160, -150}));
  CHECK(region.contains({-182, -122, -419})); // a corner of the plate
  picture.moves.push_back({PathKind::Rapid, picture.moves.back().to, {5000, 0, 0}, true, 0});
  CHECK(regionOf(picture).most.x == region.most.x);
}

TEST_CASE("picture region: a part is whole, however small what was measured; a very large one is cut, which "
          "is said") {
  Picture picture;
  PartBuilder block;
  block.box({0, 0, -30}, {100, 60, 0});
  picture.part = *finish(block);
  picture.moves = {{PathKind::Measuring, {80, 10, 3}, {84, 10, -1}, true, 0}};
  Region region = regionOf(picture);
  CHECK(region.contains({0, 0, -30}));
  CHECK(region.contains({100, 60, 0}));
  CHECK(cutNote(picture, region) == "");
  for (const std::string& shown : {pictureSvg(picture), pictureHtml(picture)})
    CHECK(shown.find("cut open") == std::string::npos);

  PartBuilder plate;
  plate.box({-900, -500, -20}, {900, 30, 0});
  picture.part = *finish(plate);
  region = regionOf(picture);
  CHECK_FALSE(region.contains({900, 0, 0}));
  CHECK(cutSidesOf(picture, region) == std::vector<std::string>{"X-", "X+", "Y-"});
  for (const std::string& shown : {pictureSvg(picture), pictureHtml(picture)})
    CHECK(shown.find("the part goes on beyond the picture at X-, X+, Y-; it is") != std::string::npos);
}

TEST_CASE("picture: a part far below, or beside, the path is in it, with its bores") {
  Picture picture;
  PartBuilder plate;
  plate.box({-350, -250, -20}, {350, 250, 0});
  for (int i = 0; i < 40; ++i)
    plate.cylinder({-300.0 + 60 * (i % 10), -200.0 + 60 * (i / 10), -15},
                   {-300.0 + 60 * (i % 10), -200.0 + 60 * (i / 10), 1}, 4, Action::Remove);
  picture.part = *finish(plate);
  const auto path = [&](double x, double y, double z) {
    picture.moves = {{PathKind::Feed, {x, y, z + 117}, {x, y, z}, true, 0},
                     {PathKind::Feed, {x, y, z}, {x + 30, y, z}, true, 0}};
  };
  // From far above to beside it: whatever lies between the path and the part, no picture is without the part.
  for (const double above : {2.0, 20.0, 35.0, 45.0, 60.0, 83.0, 87.0, 95.0, 150.0, 400.0}) {
    for (const double aside : {0.0, 300.0, 420.0, 600.0, 1500.0}) {
      if (fewDraws() && (aside == 300 || aside == 600 || above < 40 || above == 83)) continue;
      CAPTURE(above);
      CAPTURE(aside);
      path(aside + 8, 8, above);
      const Region region = regionOf(picture);
      const Region reach = reachOf(*picture.part);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        CHECK(coordinate(region.least, axis) < coordinate(reach.most, axis));
        CHECK(coordinate(region.most, axis) > coordinate(reach.least, axis));
      }
      const SectionPlanes planes = sectionPlanesOf(picture, region);
      for (std::size_t axis = 0; axis < 3; ++axis)
        CHECK_FALSE(sectionOf(*picture.part, axis, planes.at[axis], region).areas.empty());
    }
  }
  // Half way through the plate, where the bores are.
  path(8, 8, 83);
  CHECK(sectionPlanesOf(picture, regionOf(picture)).at[2] == doctest::Approx(-10).epsilon(0.02));
}

TEST_CASE("picture: the zero of the work coordinates is where the probe's tip is at their zero") {
  Picture picture = borePicture();
  CHECK_FALSE(workZeroOf(picture).has_value());
  picture.frames = {{"G54", {-300, -200, -223}}, {"G56", {-100, -50, -20}}};
  for (std::size_t i = 0; i < picture.moves.size(); ++i)
    picture.moves[i].frame = picture.moves[i].kind == PathKind::Rapid ? 1 : 0;
  const auto zero = workZeroOf(picture);
  REQUIRE(zero.has_value());
  CHECK(zero->name == "G54");
  // 180 from the gauge line to the tip.
  CHECK(zero->at == Point3{-300, -200, -403});
  CHECK(zero->zero() == zero->at);
}

TEST_CASE("picture: banner, legend and blue numbers agree whatever length is in force") {
  Picture picture = borePicture();
  const auto legend = [&] { return pictureSvg(picture); };
  const auto says = [&](const std::string& text) { return legend().find(text) != std::string::npos; };
  // The gauge line counts: the system's zero is 180 above the place where the tip is at Z0.
  picture.frames = {{"G54", {-300, -200, -400}, 0, 0.0}};
  auto zero = workZeroOf(picture);
  REQUIRE(zero.has_value());
  CHECK(zero->at == Point3{-300, -200, -580});
  CHECK(zero->zero() == Point3{-300, -200, -400});
  CHECK(says(">blue numbers: G54 as shown with the tip there, zero at machine<"));
  CHECK(says(">X-300.000 Y-200.000 Z-400.000<"));
  CHECK(says("no tool length is in force: Z counts for the gauge line,<"));
  picture.frames = {{"G54", {-300, -200, -280}, 0, 120.0}};
  CHECK(says(">X-300.000 Y-200.000 Z-400.000<"));
  CHECK(says("the length in force is 120.000: Z counts for a point, 60.000"));
  picture.frames = {{"G54", {-300, -200, -220}, 0, 180.0}};
  CHECK(says(">blue numbers: work coordinates G54, zero at machine<"));
  CHECK(says(">X-300.000 Y-200.000 Z-400.000<"));
  CHECK_FALSE(says("in force"));
  // A probe whose length goes down to the centre of its ball is shown by that.
  picture.probe.lengthToTip = false;
  zero = workZeroOf(picture);
  REQUIRE(zero.has_value());
  CHECK(zero->at == Point3{-300, -200, -400});
  picture.decimals = 4;
  CHECK(says(">X-300.0000 Y-200.0000 Z-400.0000<"));
  CHECK(says(">section at Z -407.9700<"));
}

TEST_CASE("picture sections lie where contacts are seen from the side, or just below them") {
  Picture picture = borePicture();
  SectionPlanes planes = sectionPlanesOf(picture, regionOf(picture));
  CHECK(planes.at[2] == doctest::Approx(-407.97));
  CHECK(planes.contact[2].has_value());
  picture.contacts = {{{-245, -150, -399.97}, 13}}; // on the upper face
  planes = sectionPlanesOf(picture, regionOf(picture));
  CHECK(planes.at[0] == -245);
  CHECK(planes.at[1] == -150);
  CHECK(planes.at[2] < -400);
  CHECK(planes.at[2] > -402);
  picture.contacts.clear();
  for (PictureMove& move : picture.moves) // far above the part
    move.from.z = move.to.z = -360;
  picture.errors.clear();
  planes = sectionPlanesOf(picture, regionOf(picture));
  CHECK(picture.part->distance({-290, -190, planes.at[2]}) < 0);
}

namespace {

// A fourth touch of the bore that meets nothing, and the way out of it.
Picture missPicture(const Point3& begin, const Point3& end) {
  Picture picture = borePicture();
  picture.errors.clear();
  const Point3 before = picture.moves.back().to;
  picture.blocks.push_back({"G31 X20. F100.", "bore.nc:90"});
  picture.moves.push_back({PathKind::Rapid, before, begin, true, picture.blocks.size() - 1});
  picture.moves.push_back({PathKind::Measuring, begin, end, true, picture.blocks.size() - 1});
  picture.errors.push_back(
      {end, "the probe has met nothing", picture.moves.size() - 1, std::nullopt, PictureError::Kind::Miss});
  picture.moves.push_back({PathKind::Rapid, end, {end.x, end.y, -380}, true, picture.blocks.size() - 1});
  return picture;
}

} // namespace

TEST_CASE("picture sections go through the miss with which the search ends") {
  Picture picture = missPicture({-290, -190, -405}, {-280, -190, -405});
  SectionPlanes planes = sectionPlanesOf(picture, regionOf(picture));
  CHECK(planes.at == std::array<double, 3>{-280, -190, -405});
  for (std::size_t axis = 0; axis < 3; ++axis) {
    CHECK(planes.error[axis] == 0);
    CHECK_FALSE(planes.contact[axis].has_value());
  }
  CHECK(pictureSvg(picture).find("XZ at Y -190.000, through miss M1<") != std::string::npos);
  CHECK(pictureHtml(picture).find(fmt::format("\"opens\":{},", picture.moves.size() - 2)) !=
        std::string::npos);

  // The ball goes over the plate: XY shows the face that is nearest.
  picture = missPicture({-310, -195, -390}, {-295, -195, -390});
  picture.part = std::nullopt;
  PartBuilder plate;
  plate.box({-300, -200, -420}, {-180, -120, -400});
  picture.part = *finish(plate);
  planes = sectionPlanesOf(picture, regionOf(picture));
  CHECK(planes.at[0] == -295);
  CHECK(planes.at[1] == -195);
  CHECK(planes.at[2] < -400);
  CHECK(planes.at[2] > -402);
  CHECK(planes.error[0] == 0);
  CHECK_FALSE(planes.error[2].has_value());

  // A touch that comes later is what the picture is about.
  picture = missPicture({-290, -190, -405}, {-280, -190, -405});
  picture.moves.push_back({PathKind::Measuring, {-245, -150, -382}, {-245, -150, -396.97}, true, 0});
  picture.contacts.push_back({{-245, -150, -399.97}, picture.moves.size() - 1});
  planes = sectionPlanesOf(picture, regionOf(picture));
  CHECK_FALSE(planes.error[2].has_value());
  CHECK(planes.contact[2].has_value());
  CHECK(pictureHtml(picture).find("\"opens\":null,") != std::string::npos);
}

namespace {

// The picture of a run that ends with a rapid, named by the banner.
Picture rapidPicture(const Point3& from, const Point3& to, const Point3& at) {
  Picture picture = borePicture();
  picture.errors.clear();
  picture.blocks.push_back({"G0 Z-3.", "bore.nc:91"});
  picture.moves.push_back({PathKind::Rapid, from, to, true, picture.blocks.size() - 1});
  picture.errors.push_back({at, "a rapid move runs into the part", picture.moves.size() - 1});
  picture.result = PictureResult{};
  picture.result->verdict = Verdict::Fail;
  picture.result->error = 0;
  return picture;
}

std::string headingOf(const std::string& svg, const std::string& view) {
  const std::size_t begin = svg.find("<g id=\"" + view + "\"");
  return svg.substr(begin, svg.find("</g>\n<g id", begin) - begin);
}

} // namespace

TEST_CASE("picture sections go through the place where the run failed") {
  // Onto the upper face: the three sections show the face and the ball at it, touches before it or not.
  const Point3 at{-282, -186, -396.97};
  Picture picture = rapidPicture({-282, -186, -380}, {-282, -186, -403}, at);
  const SectionPlanes planes = sectionPlanesOf(picture, regionOf(picture));
  CHECK(planes.at[0] == doctest::Approx(-282));
  CHECK(planes.at[1] == doctest::Approx(-186));
  CHECK(planes.at[2] < -400);
  CHECK(planes.at[2] > -402);
  CHECK(planes.error[0] == 0);
  CHECK(planes.error[1] == 0);
  CHECK(planes.beside[2] == 0);
  CHECK_FALSE(planes.contact[2].has_value());
  const std::string svg = pictureSvg(picture);
  CHECK(svg.find("XZ at Y -186.000, through error E1<") != std::string::npos);
  CHECK(svg.find(", inside the face at error E1<") != std::string::npos);
  for (const char* view : {"XY", "XZ", "YZ"})
    CHECK(headingOf(svg, view).find("class=\"failure\"") != std::string::npos);
  const std::string html = pictureHtml(picture);
  CHECK(html.find(fmt::format("\"opens\":{},", picture.moves.size() - 1)) != std::string::npos);
  CHECK(html.find("\"fails\":0,") != std::string::npos);

  // Nothing but the banner says which error: a run that passed shows what it touched.
  picture.result->error.reset();
  picture.result->verdict = Verdict::Pass;
  CHECK_FALSE(failureOf(picture).has_value());
  CHECK(pictureSvg(picture).find("class=\"failure\"") == std::string::npos);
}

TEST_CASE("picture sections: of a stem or a body that hits the part they show what it hits") {
  // The ball is 20 below the plate, the stem comes against its side.
  Picture picture = rapidPicture({-330, -160, -440}, {-290, -160, -440}, {-301.95, -160, -440});
  PartBuilder builder;
  builder.box({-300, -200, -420}, {-180, -120, -400});
  picture.part = *finish(builder);
  const auto touch = touchAt(picture, picture.errors[0]);
  REQUIRE(touch.has_value());
  CHECK(touch->point.x == doctest::Approx(-300));
  const SectionPlanes planes = sectionPlanesOf(picture, regionOf(picture));
  CHECK(planes.at[0] > -300);
  CHECK(planes.at[0] < -296);
  CHECK(planes.at[1] == doctest::Approx(-160));
  CHECK(picture.part->distance({-299, -160, planes.at[2]}) < 0);
  // In free air there is no touch: an over-travel.
  picture.errors[0].at = {-330, -160, -440};
  CHECK_FALSE(touchAt(picture, picture.errors[0]).has_value());
}

TEST_CASE("picture sections: a run that begins in the part is cut where the ball is") {
  const Point3 at{-290, -190, -410};
  const Picture picture = rapidPicture(at, {-290, -190, -380}, at);
  CHECK(sectionPlanesOf(picture, regionOf(picture)).at == std::array<double, 3>{-290, -190, -410});
}

TEST_CASE("picture sections: an alarm after a miss is about the miss") {
  Picture picture = missPicture({-290, -190, -405}, {-280, -190, -405});
  picture.moves.push_back({PathKind::Measuring, {-245, -150, -382}, {-245, -150, -396.97}, true, 0});
  picture.contacts.push_back({{-245, -150, -399.97}, picture.moves.size() - 1});
  picture.result = PictureResult{};
  CHECK_FALSE(failureOf(picture).has_value());
  picture.result->verdict = Verdict::Fail;
  CHECK(failureOf(picture) == 0);
}
