// How near a path comes to a part.
#pragma once

#include "sim/geometry/Part.h"

#include <limits>

namespace dotek::sim {

// Cheap along a path that stays away: a motion that cannot be nearer than what is known is not looked at, and
// none is once the path has come near.
class Clearance {
public:
  // `near`: a distance, mm, that is near enough.
  explicit Clearance(double near) : near_(near) {}

  // The next straight motion of the point that is followed. Whether it comes nearer than all before.
  bool follow(const Part& part, const Point3& from, const Point3& to);

  bool isNear() const { return least_ <= near_; }
  double least() const { return least_; } // too great by a hundredth at most, until it is near

private:
  double near_;
  double least_ = std::numeric_limits<double>::infinity();
  Point3 last_;       // where the motion before has ended
  double bound_ = -1; // the distance is no less there; below 0: not known
};

// Within this of a part a path is near: its largest size, and 50 mm at least; of a part without end 50 mm.
double nearDistance(const Part& part);

} // namespace dotek::sim
