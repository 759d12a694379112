// A point or a direction in space, for interfaces.
#pragma once

#include <cmath>

namespace dotek::sim {

struct Point3 {
  double x = 0, y = 0, z = 0; // mm

  Point3 operator+(const Point3& o) const { return {x + o.x, y + o.y, z + o.z}; }
  Point3 operator-(const Point3& o) const { return {x - o.x, y - o.y, z - o.z}; }
  Point3 operator*(double f) const { return {x * f, y * f, z * f}; }
  double dot(const Point3& o) const { return x * o.x + y * o.y + z * o.z; }
  double length() const { return std::sqrt(dot(*this)); }
  bool operator==(const Point3&) const = default;
};

} // namespace dotek::sim
