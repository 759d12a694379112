// The drawn path beside a call that touches several surfaces: what the macro does by itself is no difference,
// what leads to the call and away from it is.
#include "verify/Compare.h"
#include "verify/DrawnPath.h"

#include <doctest/doctest.h>

using namespace dotek;
using sim::Point3;

namespace {

constexpr double kBall = 3;

// A web of 40 mm along X, as a programmer draws it: from above its middle, down beside each face.
verify::DrawnPath webPath() {
  verify::DrawnPath path;
  const auto to = [&](Point3 point) {
    path.points.push_back(point);
    path.ranges.emplace_back();
  };
  const auto touch = [&](Point3 end, double direction) {
    to(end);
    verify::DrawnTouch one;
    one.touch = {{end.x + direction * kBall, end.y, end.z + kBall}, {direction, 0, 0}};
    one.move = path.points.size() - 1;
    path.touches.push_back(one);
  };
  to({0, 0, 50}); // the start
  to({0, 0, 20});
  for (const double side : {1.0, -1.0}) {
    to({side * 30, 0, 20});
    to({side * 30, 0, -8});
    touch({side * 23, 0, -8}, -side);
    to({side * 30, 0, -8});
    to({side * 30, 0, 20});
  }
  to({0, 0, 20});
  to({0, 0, 50});
  return path;
}

verify::Record program(Point3 callFrom, Point3 callTo) {
  verify::Record record;
  const auto move = [&](Point3 from, Point3 to, sim::PathKind kind) {
    verify::Piece piece;
    piece.from = from;
    piece.to = to;
    piece.kind = kind;
    record.pieces.push_back(piece);
  };
  move({0, 0, 50}, callFrom, sim::PathKind::Protected);
  move(callFrom, callTo, sim::PathKind::Measuring);
  move(callTo, {0, 0, 50}, sim::PathKind::Protected);
  verify::Measure measure;
  measure.start = callFrom;
  measure.end = callTo;
  measure.nominal = {{{20, 0, -5}, {-1, 0, 0}}, {{-20, 0, -5}, {1, 0, 0}}};
  record.measures.push_back(measure);
  record.ending = verify::Ending::Finished;
  record.end = {0, 0, 50};
  return record;
}

} // namespace

TEST_CASE("verify: the drawn path of a web beside one call that measures it") {
  const verify::DrawnPath path = webPath();
  const auto differences = [&](const verify::Record& record) {
    return verify::compare(path, {0, 0, 0}, record, 0.001);
  };
  CHECK(differences(program({0, 0, 20}, {0, 0, 20})).empty());
  // The call begins where the path never is.
  CHECK_FALSE(differences(program({0, 0, 25}, {0, 0, 20})).empty());
  CHECK_FALSE(differences(program({0, 0, 20}, {0, 0, -8})).empty());
  CHECK_FALSE(differences(program({2, 0, 20}, {2, 0, 20})).empty());
  // Another surface.
  verify::Record other = program({0, 0, 20}, {0, 0, 20});
  other.measures[0].nominal[1].point.x = -19;
  CHECK_FALSE(differences(other).empty());
}
