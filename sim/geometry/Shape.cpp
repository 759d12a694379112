#include "sim/geometry/Shape.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dotek::sim {
namespace {

double signOf(double x) {
  return x < 0 ? -1.0 : 1.0;
}

// Of a profile (distance `flat`, its gradient in the plane) stretched to |z| <= half.
double stretched(double flat, double gx, double gy, double z, double half, Vec& gradient) {
  const double high = std::abs(z) - half;
  const double sz = signOf(z);
  if (flat > 0 && high > 0) {
    const double length = std::sqrt(flat * flat + high * high);
    gradient = Vec(gx * flat / length, gy * flat / length, sz * high / length);
    return length;
  }
  if (flat > high) {
    gradient = Vec(gx, gy, 0);
    return flat;
  }
  gradient = Vec(0, 0, sz);
  return high;
}

double blockDistance(const Shape& s, const Vec& p, Vec& gradient) {
  const double sx = signOf(p.x()), sy = signOf(p.y());
  const double qx = std::abs(p.x()) - (s.a - s.d), qy = std::abs(p.y()) - (s.b - s.d);
  if (qx > 0 && qy > 0) {
    const double length = std::sqrt(qx * qx + qy * qy);
    return stretched(length - s.d, sx * qx / length, sy * qy / length, p.z(), s.c, gradient);
  }
  if (qx > qy) return stretched(qx - s.d, sx, 0, p.z(), s.c, gradient);
  return stretched(qy - s.d, 0, sy, p.z(), s.c, gradient);
}

// Sizes and places are bounded: nothing overflows, and std::hypot takes several times as long.
double lengthOf(double x, double y) {
  return std::sqrt(x * x + y * y);
}

double coneDistance(const Shape& s, const Vec& p, Vec& gradient) {
  const double rho = lengthOf(p.x(), p.y()), z = p.z();
  const double ux = rho > 0 ? p.x() / rho : 1, uy = rho > 0 ? p.y() / rho : 0;
  // The side, from (a, -c) to (b, c) in the plane of rho and z; its normal points outward.
  const double dr = s.b - s.a, dz = 2 * s.c, length = lengthOf(dr, dz);
  const double nr = dz / length, nz = -dr / length;
  const double side = (rho - s.a) * nr + (z + s.c) * nz;
  const double caps = std::abs(z) - s.c;
  if (side <= 0 && caps <= 0) { // inside: planes and a convex cone
    if (side > caps)
      gradient = Vec(ux * nr, uy * nr, nz);
    else
      gradient = Vec(0, 0, signOf(z));
    return std::max(side, caps);
  }
  // Outside: the nearest of the two caps and the side.
  const double cap = z < 0 ? s.a : s.b;
  const double toCapR = std::max(rho - cap, 0.0), toCapZ = z - signOf(z) * s.c;
  double best = lengthOf(toCapR, toCapZ), gr = toCapR, gz = toCapZ;
  const double along = std::clamp(((rho - s.a) * dr + (z + s.c) * dz) / (length * length), 0.0, 1.0);
  const double toSideR = rho - (s.a + along * dr), toSideZ = z - (-s.c + along * dz);
  if (const double d = lengthOf(toSideR, toSideZ); d < best || (caps <= 0 && d <= best)) {
    best = d;
    gr = toSideR;
    gz = toSideZ;
    if (along > 0 && along < 1) { // its own normal stays good where the distance vanishes
      gr = nr * d;
      gz = nz * d;
    }
  }
  if (best > 0) {
    gr /= best;
    gz /= best;
  } else {
    gr = side > caps ? nr : 0;
    gz = side > caps ? nz : signOf(z);
  }
  gradient = Vec(ux * gr, uy * gr, gz);
  return best;
}

} // namespace

Vec across(const Vec& axis) {
  const Vec other = std::abs(axis.x()) < 0.6 ? Vec(1, 0, 0) : Vec(0, 1, 0);
  return axis.cross(other).normalized();
}

double Shape::distance(const Vec& p) const {
  Vec unused;
  const Vec local = axes.transpose() * (p - origin);
  switch (kind) {
  case Kind::HalfSpace: return local.z();
  case Kind::Sphere: return local.norm() - a;
  case Kind::Cone: return coneDistance(*this, local, unused);
  case Kind::Block: break;
  }
  const double qx = std::abs(local.x()) - (a - d), qy = std::abs(local.y()) - (b - d);
  const double flat = (qx > 0 && qy > 0 ? std::sqrt(qx * qx + qy * qy) : std::max(qx, qy)) - d;
  const double high = std::abs(local.z()) - c;
  return flat > 0 && high > 0 ? std::sqrt(flat * flat + high * high) : std::max(flat, high);
}

double Shape::distance(const Vec& p, Vec& gradient) const {
  const Vec local = axes.transpose() * (p - origin);
  double out = 0;
  switch (kind) {
  case Kind::HalfSpace: gradient = axes.col(2); return local.z();
  case Kind::Sphere: {
    const double length = local.norm();
    gradient = length > 0 ? Vec((p - origin) / length) : Vec(axes.col(2));
    return length - a;
  }
  case Kind::Cone: out = coneDistance(*this, local, gradient); break;
  case Kind::Block: out = blockDistance(*this, local, gradient); break;
  }
  gradient = axes * gradient;
  return out;
}

double Shape::least(const Patch& patch) const {
  Vec g;
  const double middle = distance(patch.middle, g);
  return middle - std::abs(g.dot(patch.a)) - std::abs(g.dot(patch.b));
}

// Convex: the greatest value is at a corner.
double Shape::most(const Patch& patch) const {
  const double out =
      std::max(distance(patch.middle + patch.a + patch.b), distance(patch.middle - patch.a - patch.b));
  if (patch.b.isZero(0)) return out;
  return std::max(
      {out, distance(patch.middle + patch.a - patch.b), distance(patch.middle - patch.a + patch.b)});
}

double Shape::support(const Vec& direction) const {
  const Vec u = axes.transpose() * direction;
  const double flat = std::hypot(u.x(), u.y()), at = origin.dot(direction);
  switch (kind) {
  case Kind::HalfSpace: return u.z() > 0 && flat < 1e-12 ? at : std::numeric_limits<double>::infinity();
  case Kind::Sphere: return at + a;
  case Kind::Cone: return at + std::max(a * flat - c * u.z(), b * flat + c * u.z());
  case Kind::Block: break;
  }
  return at + (a - d) * std::abs(u.x()) + (b - d) * std::abs(u.y()) + d * flat + c * std::abs(u.z());
}

double Shape::bounding(Vec& centre) const {
  centre = origin;
  double radius = 2 * kFar;
  if (kind == Kind::Sphere) radius = a;
  if (kind == Kind::Block) radius = std::sqrt(a * a + b * b + c * c);
  if (kind == Kind::Cone) radius = std::hypot(std::max(a, b), c);
  if (radius >= 2 * kFar) centre = Vec::Zero();
  return std::min(radius, 2 * kFar);
}

double Surface::value(const Vec& p) const {
  const Vec w = p - origin;
  const double along = w.dot(axis);
  switch (kind) {
  case Kind::Plane: return along;
  case Kind::Sphere: return w.norm() - radius;
  case Kind::Cylinder: return (w - along * axis).norm() - radius;
  case Kind::Cone: break;
  }
  return (w - along * axis).norm() * cosine - along * sine;
}

Vec Surface::normal(const Vec& p) const {
  const Vec w = p - origin;
  if (kind == Kind::Plane) return axis;
  const Vec out = kind == Kind::Sphere ? w : Vec(w - w.dot(axis) * axis);
  const double length = out.norm();
  // On the axis every direction is as good.
  const Vec unit = length > 0 ? Vec(out / length) : across(axis);
  return kind == Kind::Cone ? Vec(cosine * unit - sine * axis) : unit;
}

int Surface::roots(const Vec& o, const Vec& d, double* t, double* discriminant) const {
  if (discriminant != nullptr) *discriminant = 1;
  const Vec w = o - origin;
  if (kind == Kind::Plane) {
    const double slope = d.dot(axis);
    if (std::abs(slope) < 1e-12) return 0;
    t[0] = -w.dot(axis) / slope;
    return 1;
  }
  double qa = d.squaredNorm(), qb = w.dot(d), qc = w.squaredNorm() - radius * radius;
  if (kind != Kind::Sphere) {
    const double wa = w.dot(axis), da = d.dot(axis);
    const Vec wp = w - wa * axis, dp = d - da * axis;
    qa = dp.squaredNorm();
    qb = wp.dot(dp);
    qc = wp.squaredNorm() - radius * radius;
    if (kind == Kind::Cone) {
      const double c2 = cosine * cosine, s2 = sine * sine;
      qa = c2 * qa - s2 * da * da;
      qb = c2 * qb - s2 * wa * da;
      qc = c2 * wp.squaredNorm() - s2 * wa * wa;
    }
  }
  if (std::abs(qa) < 1e-12) {
    if (std::abs(qb) < 1e-12) return 0;
    t[0] = -qc / (2 * qb);
    return 1;
  }
  double root = qb * qb - qa * qc;
  if (discriminant != nullptr) *discriminant = root;
  if (root < 0) {
    // A line that should touch, as that of a face which ends in a rounding.
    if (root < -1e-9 * (qb * qb + std::abs(qa * qc))) return 0;
    root = 0;
  }
  // The form that loses no digits.
  const double q = -(qb + signOf(qb) * std::sqrt(root));
  t[0] = q / qa;
  t[1] = q != 0 ? qc / q : t[0];
  if (t[0] > t[1]) std::swap(t[0], t[1]);
  return 2;
}

void addSurfaces(const Shape& shape, std::uint32_t index, std::vector<Surface>& surfaces,
                 std::vector<Apex>& apexes) {
  const auto add = [&](Surface::Kind kind, const Vec& local, const Vec& axis, double radius) -> Surface& {
    Surface out;
    out.kind = kind;
    out.origin = shape.origin + shape.axes * local;
    out.axis = shape.axes * axis;
    out.radius = radius;
    out.shape = index;
    surfaces.push_back(out);
    return surfaces.back();
  };
  const auto plane = [&](const Vec& local, const Vec& normal) {
    add(Surface::Kind::Plane, local, normal, 0);
  };
  switch (shape.kind) {
  case Shape::Kind::HalfSpace: plane(Vec::Zero(), Vec::UnitZ()); return;
  case Shape::Kind::Sphere: add(Surface::Kind::Sphere, Vec::Zero(), Vec::UnitZ(), shape.a); return;
  case Shape::Kind::Block: {
    const double x = shape.a - shape.d, y = shape.b - shape.d;
    for (const double s : {-1.0, 1.0}) {
      if (y > 0) plane(Vec(s * shape.a, 0, 0), Vec(s, 0, 0));
      if (x > 0) plane(Vec(0, s * shape.b, 0), Vec(0, s, 0));
      plane(Vec(0, 0, s * shape.c), Vec(0, 0, s));
    }
    if (!(shape.d > 0)) return;
    for (const double sx : {-1.0, 1.0}) {
      for (const double sy : {-1.0, 1.0}) {
        if ((!(x > 0) && sx > 0) || (!(y > 0) && sy > 0)) continue; // one axis, not two
        add(Surface::Kind::Cylinder, Vec(sx * x, sy * y, 0), Vec::UnitZ(), shape.d);
      }
    }
    return;
  }
  case Shape::Kind::Cone: {
    const double grows = shape.b > shape.a ? 1 : -1; // the way in which it opens
    const double most = std::max(shape.a, shape.b), least = std::min(shape.a, shape.b);
    const double height = 2 * shape.c, length = std::hypot(most - least, height);
    const Vec apex(0, 0, -grows * (shape.c + least * height / (most - least)));
    Surface& cone = add(Surface::Kind::Cone, apex, Vec(0, 0, grows), most);
    cone.sine = (most - least) / length;
    cone.cosine = height / length;
    if (!(least > 0)) apexes.push_back({cone.origin, cone.axis});
    if (shape.a > 0) plane(Vec(0, 0, -shape.c), Vec(0, 0, -1));
    if (shape.b > 0) plane(Vec(0, 0, shape.c), Vec(0, 0, 1));
    return;
  }
  }
}

} // namespace dotek::sim
