// Random parts beside a membership test of their own, which shares no code with the part.
#pragma once

#include "sim/geometry/Contact.h"
#include "sim/geometry/Part.h"

#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace dotek::tests {

using sim::Part;
using sim::PartBuilder;
using sim::Point3;

// The same numbers everywhere.
class PartRandom {
public:
  explicit PartRandom(std::uint64_t seed) : state_(seed * 7919 + 20261121) {}
  std::uint32_t below(std::uint32_t n) {
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return static_cast<std::uint32_t>((state_ >> 33) % n);
  }
  double between(double least, double most) { return least + (most - least) * below(1'000'001) / 1e6; }
  Point3 point(double size) { return {between(-size, size), between(-size, size), between(-size, size)}; }
  Point3 direction() {
    for (;;) {
      const Point3 p = point(1);
      const double length = std::sqrt(p.dot(p));
      if (length > 0.1 && length < 1) return p * (1 / length);
    }
  }

private:
  std::uint64_t state_;
};

inline double lengthOf(const Point3& p) {
  return std::sqrt(p.dot(p));
}

inline std::unique_ptr<Part> finish(PartBuilder& builder) {
  std::string fault;
  std::unique_ptr<Part> part = builder.finish(fault);
  if (!fault.empty()) throw std::runtime_error(fault);
  return part;
}

struct RandomPart {
  using Inside = std::function<bool(const Point3&)>;
  std::unique_ptr<Part> part;
  std::vector<std::pair<PartBuilder::Action, Inside>> shapes;

  bool contains(const Point3& p) const {
    bool in = false;
    for (const auto& [action, inside] : shapes) {
      const bool here = inside(p);
      in = action == PartBuilder::Action::Add      ? in || here
           : action == PartBuilder::Action::Remove ? in && !here
                                                   : in && here;
    }
    return in;
  }

  // A part of which something is left.
  static RandomPart make(std::uint64_t seed) {
    for (std::uint64_t attempt = 0;; attempt += 100'000) {
      RandomPart out = attemptOf(seed + attempt);
      if (out.part) return out;
    }
  }

private:
  static RandomPart attemptOf(std::uint64_t seed) {
    using Action = PartBuilder::Action;
    PartRandom random(seed);
    RandomPart out;
    PartBuilder builder;
    const std::uint32_t count = 1 + random.below(6);
    for (std::uint32_t n = 0; n < count; ++n) {
      const std::uint32_t choice = random.below(10);
      const Action action = n == 0 || choice < 4 ? Action::Add : choice < 9 ? Action::Remove : Action::Keep;
      out.shapes.emplace_back(action, shape(builder, random, action));
    }
    std::string fault;
    out.part = builder.finish(fault);
    if (!fault.empty() && fault != "nothing is left of the part") throw std::runtime_error(fault);
    return out;
  }

  static Inside shape(PartBuilder& builder, PartRandom& random, PartBuilder::Action action) {
    switch (random.below(5)) {
    case 0: { // whole numbers, so that faces coincide
      const auto whole = [&](double least, double most) { return std::round(random.between(least, most)); };
      const Point3 a{whole(-12, 0), whole(-12, 0), whole(-12, 0)};
      const Point3 b{whole(1, 12), whole(1, 12), whole(1, 12)};
      builder.box(a, b, action);
      return [=](const Point3& p) {
        return p.x > a.x && p.x < b.x && p.y > a.y && p.y < b.y && p.z > a.z && p.z < b.z;
      };
    }
    case 1: {
      const Point3 a = random.point(10);
      const Point3 d = random.below(2) == 0 ? random.direction() : Point3{0, 0, 1};
      const double height = random.between(2, 30), radius = random.between(1, 9);
      builder.cylinder(a, a + d * height, radius, action);
      return [=](const Point3& p) {
        const double along = (p - a).dot(d);
        return along > 0 && along < height && lengthOf(p - a - d * along) < radius;
      };
    }
    case 2: {
      const Point3 a = random.point(10), d = random.direction();
      const double height = random.between(2, 20), bottom = random.between(1, 8);
      const double top = random.below(3) == 0 ? 0 : random.between(1, 8);
      builder.cone(a, bottom, a + d * height, top, action);
      return [=](const Point3& p) {
        const double along = (p - a).dot(d);
        return along > 0 && along < height &&
               lengthOf(p - a - d * along) < bottom + (top - bottom) * along / height;
      };
    }
    case 3: {
      const Point3 c = random.point(9);
      const double radius = random.between(2, 9);
      builder.sphere(c, radius, action);
      return [=](const Point3& p) { return lengthOf(p - c) < radius; };
    }
    default: { // rounded, on its own axes
      const Point3 c = random.point(6);
      const Point3 half{random.between(2, 10), random.between(2, 10), random.between(2, 10)};
      const double corner = random.between(0, std::min(half.x, half.y));
      const double angle = random.between(0, 180);
      builder.box(c - half, c + half, action, corner, {0, 0, angle});
      return [=](const Point3& p) {
        const double s = std::sin(angle * M_PI / 180), k = std::cos(angle * M_PI / 180);
        const Point3 w = p - c;
        const double x = std::abs(k * w.x + s * w.y), y = std::abs(k * w.y - s * w.x);
        if (x >= half.x || y >= half.y || std::abs(w.z) >= half.z) return false;
        const double ox = x - (half.x - corner), oy = y - (half.y - corner);
        return ox <= 0 || oy <= 0 || ox * ox + oy * oy < corner * corner;
      };
    }
    }
  }
};

} // namespace dotek::tests
