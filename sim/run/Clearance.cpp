#include "sim/run/Clearance.h"

#include "sim/picture/PictureRegion.h"

#include <algorithm>
#include <cmath>

namespace dotek::sim {
namespace {

constexpr double kShare = 0.01; // of the least distance, that it may be too great by

bool isSame(const Point3& a, const Point3& b) {
  return a.x == b.x && a.y == b.y && a.z == b.z;
}

} // namespace

bool Clearance::follow(const Part& part, const Point3& from, const Point3& to) {
  if (isNear()) return false;
  const Point3 way = to - from;
  const double length = way.length();
  if (!std::isfinite(length) || !std::isfinite(from.x + from.y + from.z)) return false;
  // A distance changes by no more than the way.
  const double known = bound_ >= 0 && isSame(from, last_) ? bound_ - length : -1;
  last_ = to;
  bound_ = known;
  if (known >= 0 && known >= least_ * (1 - kShare)) return false;
  const double before = least_;
  for (double at = 0;;) {
    const double distance = part.distance(length > 0 ? from + way * (at / length) : from);
    least_ = std::min(least_, distance);
    bound_ = distance;
    if (isNear() || at >= length) break;
    at = std::min(length, at + distance - least_ * (1 - kShare));
  }
  return least_ < before;
}

double nearDistance(const Part& part) {
  constexpr double kLeast = 50;
  const Region reach = reachOf(part);
  const Point3 size = reach.most - reach.least;
  const double largest = std::max({size.x, size.y, size.z});
  return largest < kDrawn / 10 ? std::max(kLeast, largest) : kLeast;
}

} // namespace dotek::sim
