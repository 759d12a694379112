// Convex shapes with exact signed distances, and the surfaces they are made of. Private to the part.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <array>
#include <cstdint>
#include <vector>

namespace dotek::sim {

using Vec = Eigen::Vector3d;
using Rot = Eigen::Matrix3d;

// What is farther from the part's zero than this (mm) does not exist: no machine reaches it.
inline constexpr double kFar = 2e4;

// A parallelogram: middle and half sides. A segment where one half side is zero.
struct Patch {
  Vec middle, a, b;
};

// Its signed distance (negative inside) is exact and convex, so a tangent is a lower bound everywhere.
struct Shape {
  enum class Kind : std::uint8_t {
    HalfSpace, // z <= 0
    Block,     // |x| <= a, |y| <= b, |z| <= c, vertical edges rounded by d: box, cylinder, slot, pocket
    Cone,      // |z| <= c, radius a at -c, b at +c
    Sphere,    // radius a
  };
  Kind kind = Kind::Sphere;
  Vec origin = Vec::Zero();
  Rot axes = Rot::Identity(); // columns: the shape's x, y and z
  double a = 0, b = 0, c = 0, d = 0;

  double distance(const Vec& p) const;
  double distance(const Vec& p, Vec& gradient) const; // a unit vector that supports it
  // On a patch: a lower bound of the distance, and its greatest value.
  double least(const Patch& patch) const;
  double most(const Patch& patch) const;
  // How far it reaches along a unit vector: the greatest x . direction of its points; infinity: without end.
  double support(const Vec& direction) const;
  // A ball that holds the shape; the radius is at most kFar * 2.
  double bounding(Vec& centre) const;
};

// Of a shape's hull, not bounded: the plane of a face, the whole cylinder of a rounded edge.
struct Surface {
  enum class Kind : std::uint8_t { Plane, Cylinder, Cone, Sphere };
  Kind kind = Kind::Plane;
  Vec origin = Vec::Zero();    // on the plane, on the axis, the apex, the centre
  Vec axis = Vec::UnitZ();     // normal of the plane, or unit vector of the axis; from the apex into the cone
  double radius = 0;           // of the cylinder, the sphere; of the cone the largest that its shape has
  double sine = 0, cosine = 1; // of half the cone's angle
  std::uint32_t shape = 0;

  // Distance with a sign and its unit gradient; of a cone along the normal of the nearest side.
  double value(const Vec& p) const;
  Vec normal(const Vec& p) const;
  // Roots t of the line o + t d on the surface; a cone counts with both its halves. 0 to 2, ascending; none
  // where the line lies in the surface. One that misses by rounding touches. `discriminant`: 1 where there is
  // none.
  int roots(const Vec& o, const Vec& d, double* t, double* discriminant = nullptr) const;
};

// Appends the surfaces of shape number `index` and the apex of a cone, with its axis, to the lists.
struct Apex {
  Vec point, axis;
};
void addSurfaces(const Shape& shape, std::uint32_t index, std::vector<Surface>& surfaces,
                 std::vector<Apex>& apexes);

// Some unit vector across `axis`.
Vec across(const Vec& axis);

} // namespace dotek::sim
