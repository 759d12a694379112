#include "verify/DrawnPath.h"

#include "sim/geometry/Contact.h"
#include "support/Decimal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace dotek::verify {
namespace {

using frontend::gibbs::PathMove;
using sim::Part;
using sim::Point3;

constexpr double kSame = 1e-9;     // mm: coordinates that differ by rounding
constexpr double kExact = 1e-6;    // mm: a contact is where it was drawn
constexpr double kLeastWay = 0.01; // mm to a touch; macros take less for a stylus that is deflected

// The path of a move along one axis, or at an angle in the plane XY.
struct Step {
  static constexpr int kOblique = 3;
  int axis = -1; // none: none of these, or it is
  double way = 0;
  Point3 direction = {}; // of one at an angle
};

Step stepOf(const Point3& from, const Point3& to) {
  const std::array<double, 3> way{to.x - from.x, to.y - from.y, to.z - from.z};
  Step out;
  for (int axis = 0; axis < 3; ++axis) {
    const double part = way[static_cast<std::size_t>(axis)];
    if (std::abs(part) <= kSame) continue;
    if (out.axis >= 0) {
      const double length = std::hypot(way[0], way[1]);
      if (std::abs(way[2]) > kSame) return {};
      return {Step::kOblique, length, {way[0] / length, way[1] / length, 0}};
    }
    out = {axis, part};
  }
  return out;
}

Touch touchAt(const Point3& end, const Step& step, double ballRadius) {
  const double sign = step.way > 0 ? 1 : -1;
  if (step.axis == 2) return {end, {0, 0, sign}};
  const Point3 direction = step.axis == Step::kOblique ? step.direction
                           : step.axis == 0            ? Point3{sign, 0, 0}
                                                       : Point3{0, sign, 0};
  return {end + direction * ballRadius + Point3{0, 0, ballRadius}, direction};
}

void findTouches(DrawnPath& path, double ballRadius) {
  const std::vector<Point3>& points = path.points;
  for (std::size_t n = 1; n + 1 < points.size(); ++n) {
    const Step step = stepOf(points[n - 1], points[n]), next = stepOf(points[n], points[n + 1]);
    if (step.axis < 0 || next.axis != step.axis) continue;
    if (step.axis == Step::kOblique) {
      // Straight back to where it began; what comes after it is the path back, and no touch by itself.
      const bool goesBack = (points[n + 1] - points[n - 1]).length() <= kSame;
      if (goesBack && (path.touches.empty() || path.touches.back().move + 1 != n))
        path.touches.push_back({touchAt(points[n], step, ballRadius), n, path.ranges[n]});
      continue;
    }
    if (step.way * next.way >= 0) continue;
    if (step.axis == 2 && step.way > 0) continue;
    if (!path.touches.empty() &&
        path.touches.back().move + 1 == n) { // the path back, or on to the other side
      const Step before = stepOf(points[n - 2], points[n - 1]);
      if (before.axis == step.axis && std::abs(step.way) <= std::abs(before.way) + kSame) continue;
    }
    path.touches.push_back({touchAt(points[n], step, ballRadius), n, path.ranges[n]});
  }
}

// ---- walking

std::string at(const Point3& p) {
  return fmt::format("X{} Y{} Z{}", fixedText(p.x, 3), fixedText(p.y, 3), fixedText(p.z, 3));
}

class Walk {
public:
  Walk(const DrawnPath& path, const Part& part, const sim::Probe& probe, double off, double near)
      : path_(path), part_(part), probe_(probe), off_(off + kExact), near_(near),
        at_(path.points.front() + up()) {}

  std::string run() {
    std::size_t touch = 0;
    for (std::size_t n = 1; n < path_.points.size(); ++n) {
      const bool measures = touch < path_.touches.size() && path_.touches[touch].move == n;
      std::string why = measures ? measure(path_.touches[touch++], n) : pass(n);
      if (!why.empty()) return why;
    }
    return "";
  }

private:
  Point3 up() const { return {0, 0, probe_.ballRadius()}; }

  std::string pass(std::size_t n) {
    const Point3 to = path_.points[n] + up();
    if (const auto touch = sim::firstContact(part_, probe_.ballRadius(), at_, to))
      return fmt::format("move {} runs into the part at {}", n, at(touch->centre - up()));
    std::string why = collision(to - at_, n);
    at_ = to;
    return why;
  }

  std::string measure(const DrawnTouch& drawn, std::size_t n) {
    const Point3 end = path_.points[n] + up();
    const Point3 direction = drawn.touch.direction;
    // A little beyond it may come, so that a contact at the limit is not lost to rounding.
    const auto touch = sim::firstContact(part_, probe_.ballRadius(), at_, end + direction * (2 * off_));
    if (!touch) return fmt::format("move {} does not reach the surface it touches", n);
    if (touch->atStart || touch->share * (end + direction * (2 * off_) - at_).length() < kLeastWay)
      return fmt::format("move {} touches where it begins", n);
    if (std::abs((touch->centre - end).dot(direction)) > off_)
      return fmt::format("move {} touches at {}, not where it ends", n, at(touch->centre - up()));
    if (near_ > 0) {
      // A ball that is larger by that touches what it measures earlier, by as much.
      const auto beside = sim::firstContact(part_, probe_.ballRadius() + near_, at_, end);
      if (beside && (touch->centre - beside->centre).dot(direction) > 2 * near_)
        return fmt::format("move {} passes the part too near", n);
    }
    std::string why = collision(touch->centre - at_, n);
    at_ = touch->centre;
    return why;
  }

  // Of the stem and the body.
  std::string collision(const Point3& way, std::size_t n) const {
    if (!(probe_.stemDiameter > 0) || !(way.length() > 0)) return "";
    const Point3 top = at_ + Point3{0, 0, probe_.stemLength};
    if (collides({at_, top, probe_.stemDiameter / 2}, way))
      return fmt::format("the stem runs into the part in move {}", n);
    if (!(probe_.bodyDiameter > 0)) return "";
    const double radius = probe_.bodyDiameter / 2; // its round end lies within it
    if (collides(
            {top + Point3{0, 0, radius}, top + Point3{0, 0, std::max(radius, probe_.bodyLength)}, radius},
            way))
      return fmt::format("the probe's body runs into the part in move {}", n);
    return "";
  }
  bool collides(const sim::Capsule& capsule, const Point3& way) const {
    return sim::collides(part_, capsule, way);
  }

  const DrawnPath& path_;
  const Part& part_;
  const sim::Probe& probe_;
  double off_, near_;
  Point3 at_; // of the ball's centre
};

} // namespace

std::vector<Touch> DrawnPath::nominal() const {
  std::vector<Touch> out;
  out.reserve(touches.size());
  for (const DrawnTouch& each : touches)
    out.push_back(each.touch);
  return out;
}

DrawnPath drawnPath(const std::vector<PathMove>& path, const Point3& start, double retract,
                    double ballRadius) {
  DrawnPath out;
  out.points.reserve(path.size() + 1);
  out.ranges.reserve(path.size() + 1);
  out.points.push_back(start);
  out.ranges.emplace_back();
  Point3 here = start;
  for (const PathMove& move : path) {
    const bool all = move.kind == PathMove::Kind::Feed;
    if (all || move.kind == PathMove::Kind::FeedX) here.x = start.x + move.x;
    if (all || move.kind == PathMove::Kind::FeedY) here.y = start.y + move.y;
    if (all || move.kind == PathMove::Kind::FeedZ) here.z = retract + move.z;
    out.points.push_back(here);
    out.ranges.push_back(move.range);
  }
  findTouches(out, ballRadius);
  return out;
}

std::string whyNoWay(const DrawnPath& path) {
  if (path.touches.empty())
    return "the path shows no touch; draw the move to each surface and the one back in ToolPath.mac: the "
           "part is "
           "made from them";
  double highest = path.points[1].z;
  for (std::size_t n = 2; n < path.points.size(); ++n)
    highest = std::max(highest, path.points[n].z);
  return path.points.back().z < highest - kSame ? "the path ends lower than it was" : "";
}

std::string whyNotReached(const DrawnPath& path, const Part& part, const sim::Probe& probe, double off,
                          double near) {
  std::string why = whyNoWay(path);
  return why.empty() ? Walk(path, part, probe, off, near).run() : why;
}

} // namespace dotek::verify
