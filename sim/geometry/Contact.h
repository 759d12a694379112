// What a ball or a capsule meets on a straight path through a part. Nothing is sampled: no wall is too thin.
#pragma once

#include "sim/geometry/Part.h"

#include <optional>

namespace dotek::sim {

struct Touch {
  double share = 0;     // of the path, 0 to 1
  bool atStart = false; // it touches before it moves, and does not move away
  Point3 centre;        // of the ball
  Point3 point;         // of the part
  Point3 normal;        // away from the material
};

// The first point of the path at which a ball of `radius` touches; nothing: it does not. Exact to 1e-9 mm.
// What a ball touches at the start counts only if the path leads deeper or stays there: to move away is no
// contact. A graze of less than 0.25 um (for ways above 0.5 m: half a millionth of the path) may be passed
// over.
std::optional<Touch> firstContact(const Part& part, double radius, const Point3& from, const Point3& to);

// A cylinder with round ends.
struct Capsule {
  Point3 a, b; // ends of its axis, at the start of the path
  double radius = 0;
};
// How far before its true place `firstCollision` may find a collision, mm.
constexpr double kCollisionMargin = 1e-3;
// The first share of the path, which leads by `way`, at which the capsule touches. On the safe side by
// kCollisionMargin: it may touch a gap smaller than that.
std::optional<double> firstCollision(const Part& part, const Capsule& capsule, const Point3& way);

// Whether firstCollision() is at any share; faster where there is one.
bool collides(const Part& part, const Capsule& capsule, const Point3& way);

} // namespace dotek::sim
