#include "verify/Nominal.h"

#include "ir/Arithmetic.h"
#include "sim/machine/Arguments.h"
#include "sim/machine/Value.h"
#include "stdlib/ReadCall.h"

#include <array>
#include <cmath>
#include <optional>

namespace dotek::verify {

using stdlib::ArgumentRole;
using stdlib::Intent;

namespace {

constexpr double kNothing = 1e-9;

double& part(sim::Point3& p, std::size_t axis) {
  return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

class Call {
public:
  Call(const stdlib::MacroSignature& signature, std::span<const double> locals, const sim::Point3& start,
       double ballRadius)
      : signature_(signature), locals_(locals), start_(start), ball_(ballRadius) {}

  std::vector<Touch> touches() {
    switch (signature_.intent) {
    case Intent::Surface:
    case Intent::InnerCorner: surface(); break;
    case Intent::Bore:
    case Intent::Boss: round(); break;
    case Intent::Pocket:
    case Intent::Web: flat(); break;
    case Intent::Angle: face(); break;
    case Intent::AngledSurface: angledSurface(); break;
    case Intent::AngledPocket:
    case Intent::AngledWeb: angledPair(); break;
    case Intent::ThreePointBore:
    case Intent::ThreePointBoss: threePoints(); break;
    default: break;
    }
    return std::move(out_);
  }

private:
  std::optional<double> value(ArgumentRole role, ir::Axis axis = ir::Axis::X) const {
    const stdlib::MacroArgument* found = signature_.find(role, axis);
    if (found == nullptr) return std::nullopt;
    const std::uint32_t local = stdlib::localOf(found->letter);
    if (local >= locals_.size() || sim::isNull(locals_[local]) || sim::isUnknown(locals_[local]))
      return std::nullopt;
    return locals_[local];
  }

  // The surface at `distance` from `from` along a direction in the plane, or along Z.
  void add(const sim::Point3& from, const sim::Point3& direction, double distance) {
    sim::Point3 point = from + direction * distance;
    if (direction.z == 0) point.z = from.z + ball_;
    out_.push_back({point, direction});
  }
  static sim::Point3 unit(std::size_t axis, double sign) {
    sim::Point3 out;
    part(out, axis) = sign;
    return out;
  }

  void surface() {
    for (const ir::Axis axis : ir::kAxes) {
      const stdlib::MacroArgument* target = signature_.find(ArgumentRole::Target, axis);
      const auto given = value(ArgumentRole::Target, axis);
      if (!given) continue;
      const std::size_t i = ir::indexOf(axis);
      sim::Point3 start = start_;
      const double way = *given - (target->frame == ir::Frame::Here ? 0 : part(start, i));
      if (std::abs(way) < kNothing) continue;
      add(start_, unit(i, way > 0 ? 1 : -1), std::abs(way));
    }
  }

  // Above the middle, or down beside it where the call says how deep.
  sim::Point3 probed() const {
    sim::Point3 out = start_;
    out.z = value(ArgumentRole::Depth).value_or(out.z);
    return out;
  }
  // From within, or from outside where the call keeps away from the feature.
  bool outside() const {
    return value(ArgumentRole::Depth) && value(ArgumentRole::Clearance).value_or(1) > 0;
  }
  void pair(std::size_t axis, double width) {
    for (const double sign : {1.0, -1.0}) {
      sim::Point3 point = probed() + unit(axis, sign) * (width / 2);
      point.z += ball_;
      out_.push_back({point, unit(axis, outside() ? -sign : sign)});
    }
  }
  void round() {
    const auto diameter = value(ArgumentRole::Diameter);
    if (!diameter) return;
    pair(0, *diameter);
    pair(1, *diameter);
  }
  void flat() {
    for (const ir::Axis axis : ir::kAxes)
      if (const auto width = value(ArgumentRole::Width, axis)) pair(ir::indexOf(axis), *width);
  }

  void face() {
    for (const ir::Axis normal : {ir::Axis::X, ir::Axis::Y}) {
      const auto target = value(ArgumentRole::Target, normal);
      if (!target) continue;
      const std::size_t n = ir::indexOf(normal), f = 1 - n;
      const auto spacing = value(ArgumentRole::Spacing, normal == ir::Axis::X ? ir::Axis::Y : ir::Axis::X);
      sim::Point3 from = start_;
      const double way = *target - part(from, n);
      if (!spacing || std::abs(way) < kNothing) continue;
      for (const double half : {-0.5, 0.5}) {
        sim::Point3 beside = start_;
        part(beside, f) += half * std::abs(*spacing);
        add(beside, unit(n, way > 0 ? 1 : -1), std::abs(way));
      }
    }
  }

  static sim::Point3 directionOf(double angle) {
    return {ir::cosine(angle, ir::AngleUnit::Degrees).value, ir::sine(angle, ir::AngleUnit::Degrees).value,
            0};
  }
  void angledSurface() {
    const auto angle = value(ArgumentRole::Direction), distance = value(ArgumentRole::Distance);
    if (!angle || !distance) return;
    add(start_, directionOf(*angle), *distance);
  }
  // The wall on that side of the middle, touched from within or from outside.
  void side(const sim::Point3& direction, double away) {
    sim::Point3 point = probed() + direction * away;
    point.z += ball_;
    out_.push_back({point, direction * (outside() ? -1 : 1)});
  }
  void angledPair() {
    const auto angle = value(ArgumentRole::Direction), width = value(ArgumentRole::Width);
    if (!angle || !width) return;
    for (const double sign : {1.0, -1.0})
      side(directionOf(*angle) * sign, *width / 2);
  }
  void threePoints() {
    const auto diameter = value(ArgumentRole::Diameter);
    for (const ArgumentRole role :
         {ArgumentRole::FirstAngle, ArgumentRole::SecondAngle, ArgumentRole::ThirdAngle})
      if (const auto angle = value(role); angle && diameter) side(directionOf(*angle), *diameter / 2);
  }

  const stdlib::MacroSignature& signature_;
  std::span<const double> locals_;
  const sim::Point3 start_;
  const double ball_;
  std::vector<Touch> out_;
};

} // namespace

const stdlib::MacroSignature* signatureOf(const stdlib::MacroSet& set, std::uint32_t program,
                                          std::span<const double> locals) {
  return stdlib::readCall(set, program, sim::givenLetters(locals).letters).signature;
}

std::vector<Touch> nominalTouches(const stdlib::MacroSignature& signature, std::span<const double> locals,
                                  const sim::Point3& start, double ballRadius) {
  return Call(signature, locals, start, ballRadius).touches();
}

} // namespace dotek::verify
