#include "backends/gibbs/PathCycles.h"

#include "ir/Fold.h"
#include "stdlib/MacroCycle.h"

#include <algorithm>
#include <string>
#include <utility>

namespace dotek::backends::gibbs {

namespace {

using ir::ExpressionPtr;
using stdlib::ArgumentRole;
using stdlib::Intent;

constexpr double kRightAngle = 90;

ExpressionPtr join(ir::BinaryOp op, const ExpressionPtr& a, const ExpressionPtr& b) {
  return ir::simplify(ir::binary(op, a, b, a->range));
}
ExpressionPtr plus(const ExpressionPtr& a, const ExpressionPtr& b) {
  return join(ir::BinaryOp::Add, a, b);
}
ExpressionPtr minus(const ExpressionPtr& a, const ExpressionPtr& b) {
  return join(ir::BinaryOp::Subtract, a, b);
}
ExpressionPtr times(const ExpressionPtr& a, const ExpressionPtr& b) {
  return join(ir::BinaryOp::Multiply, a, b);
}
ExpressionPtr half(const ExpressionPtr& a) {
  return join(ir::BinaryOp::Divide, a, ir::constant(2));
}
ExpressionPtr negated(const ExpressionPtr& a) {
  return ir::simplify(ir::unary(ir::UnaryOp::Negate, a, a->range));
}

// In the plane XY, length 1. A part of nullptr is 0.
struct Way {
  ExpressionPtr x, y;
  // The one axis that it follows, and its sign.
  std::optional<std::pair<ir::Axis, double>> axis() const {
    if ((x == nullptr) == (y == nullptr)) return std::nullopt;
    const double* part = ir::constantValue(x != nullptr ? x : y);
    return part == nullptr ? std::nullopt
                           : std::optional(std::pair(x != nullptr ? ir::Axis::X : ir::Axis::Y, *part));
  }
  Way opposite() const { return {x ? negated(x) : nullptr, y ? negated(y) : nullptr}; }
};

Way along(ir::Axis axis) {
  const ExpressionPtr one = ir::constant(1);
  return axis == ir::Axis::X ? Way{one, nullptr} : Way{nullptr, one};
}

Way atAngle(const ExpressionPtr& angle) {
  const auto part = [&](ir::UnaryOp op) {
    ExpressionPtr out = ir::simplify(ir::unary(op, angle, angle->range));
    const double* known = ir::constantValue(out);
    return known != nullptr && *known == 0 ? nullptr : out;
  };
  return {part(ir::UnaryOp::Cosine), part(ir::UnaryOp::Sine)};
}

class Drawing {
public:
  Drawing(const ir::CallCycle& cycle, const PathState& now, const ir::Origin& origin)
      : cycle_(cycle), now_(now), origin_(origin) {}

  std::optional<DrawnCycle> draw() {
    if (!cycle_.returns || !draws()) return std::nullopt;
    const ExpressionPtr none = ir::constant(0);
    for (const ir::ResultName name :
         {ir::ResultName::ErrorX, ir::ResultName::ErrorY, ir::ResultName::ErrorZ, ir::ResultName::SizeError,
          ir::ResultName::AngleError, ir::ResultName::TruePosition, ir::ResultName::OutOfTolerance,
          ir::ResultName::ProbeError})
      out_.values.emplace(name, none);
    return std::move(out_);
  }

private:
  bool is(Intent intent) const { return cycle_.cycle == stdlib::intentName(intent); }

  const ir::CycleArgument* find(ArgumentRole role, std::optional<ir::Axis> axis = std::nullopt) const {
    std::string name(stdlib::roleName(role));
    if (axis) name += std::string(" ") + "xyz"[ir::indexOf(*axis)];
    const auto found = std::find_if(cycle_.arguments.begin(), cycle_.arguments.end(),
                                    [&](const ir::CycleArgument& one) { return one.parameter == name; });
    return found == cycle_.arguments.end() ? nullptr : &*found;
  }
  ExpressionPtr value(ArgumentRole role, std::optional<ir::Axis> axis = std::nullopt) const {
    const ir::CycleArgument* const found = find(role, axis);
    return found == nullptr ? nullptr : found->value;
  }

  bool draws() {
    if (is(Intent::Surface)) return faces();
    if (is(Intent::InnerCorner))
      return find(ArgumentRole::Spacing, ir::Axis::X) == nullptr &&
             find(ArgumentRole::Spacing, ir::Axis::Y) == nullptr && faces();
    if (is(Intent::Bore) || is(Intent::Boss)) return round();
    if (is(Intent::Pocket) || is(Intent::Web)) return flat();
    if (is(Intent::Angle)) return angle();
    if (is(Intent::AngledSurface)) return angledFace();
    if (is(Intent::AngledPocket) || is(Intent::AngledWeb)) return angledFlat();
    if (is(Intent::ThreePointBore) || is(Intent::ThreePointBoss)) return threePoints();
    return false;
  }

  static ir::ResultName position(ir::Axis axis) {
    constexpr ir::ResultName kNames[] = {ir::ResultName::PositionX, ir::ResultName::PositionY,
                                         ir::ResultName::PositionZ};
    return kNames[ir::indexOf(axis)];
  }
  void foundHere(ir::Axis axis) { out_.places[position(axis)] = {ir::constant(0), ir::Frame::Here, nullptr}; }

  void add(ir::CycleStatement statement) {
    statement.origin = origin_;
    out_.steps.push_back(std::move(statement));
  }
  void go(const Way& way, const ExpressionPtr& distance) {
    ir::Move move;
    move.motion = ir::Motion::Protected;
    if (way.x) move.axes[0] = ir::Coordinate{times(way.x, distance), ir::Frame::Here, nullptr};
    if (way.y) move.axes[1] = ir::Coordinate{times(way.y, distance), ir::Frame::Here, nullptr};
    add({std::move(move), {}});
  }
  void goTo(const ExpressionPtr& height, ir::Frame frame) {
    ir::Move move;
    move.motion = ir::Motion::Protected;
    move.axes[2] = ir::Coordinate{height, frame, nullptr};
    add({std::move(move), {}});
  }
  void face(ir::Axis axis, const ExpressionPtr& target, ir::Frame frame) {
    ir::Measure measure;
    measure.axis = axis;
    measure.target = ir::Coordinate{target, frame, nullptr};
    add({std::move(measure), {}});
  }

  // The surface is `expected` ahead of the middle of the ball.
  void touch(const Way& way, const ExpressionPtr& expected) {
    if (const auto axis = way.axis())
      return face(axis->first, times(ir::constant(axis->second), expected), ir::Frame::Here);
    const ExpressionPtr travel = minus(expected, now_.ball());
    go(way, travel);
    go(way.opposite(), travel);
  }

  // A depth makes it a touch from outside, or, with a clearance below 0, from inside beyond an island.
  bool findSides() {
    depth_ = value(ArgumentRole::Depth);
    if (depth_ == nullptr) return true;
    beside_ = value(ArgumentRole::Clearance);
    if (beside_ == nullptr && now_.clearance) beside_ = ir::constant(*now_.clearance);
    if (beside_ == nullptr) return false;
    const double* const known = ir::constantValue(ir::simplify(beside_));
    if (known != nullptr && *known == 0) return false;
    const ExpressionPtr sign =
        known != nullptr ? ir::constant(*known < 0 ? -1 : 1)
                         : join(ir::BinaryOp::Divide, beside_, ir::unary(ir::UnaryOp::Absolute, beside_));
    gap_ = plus(beside_, times(sign, now_.ball()));
    return true;
  }
  void side(const Way& way, const ExpressionPtr& expected) {
    if (depth_ == nullptr) return touch(way, expected);
    const ExpressionPtr out = plus(expected, gap_);
    go(way, out);
    goTo(depth_, ir::Frame::Work);
    if (const auto axis = way.axis()) {
      face(axis->first, times(ir::constant(-axis->second), gap_), ir::Frame::Here);
    } else {
      go(way.opposite(), beside_);
      go(way, beside_);
    }
    goTo(now_.height, ir::Frame::Start);
    go(way.opposite(), out);
  }
  void pair(const Way& way, const ExpressionPtr& size) {
    side(way, half(size));
    side(way.opposite(), half(size));
  }

  bool faces() {
    bool any = false;
    for (const ir::Axis axis : ir::kAxes) {
      const ir::CycleArgument* const target = find(ArgumentRole::Target, axis);
      if (target == nullptr || !target->frame) continue;
      any = true;
      face(axis, target->value, *target->frame);
      out_.places[position(axis)] = {target->value, *target->frame, nullptr};
    }
    return any;
  }

  bool round() {
    const ExpressionPtr diameter = value(ArgumentRole::Diameter);
    if (diameter == nullptr || !findSides()) return false;
    for (const ir::Axis axis : {ir::Axis::X, ir::Axis::Y}) {
      pair(along(axis), diameter);
      foundHere(axis);
    }
    out_.values[ir::ResultName::Size] = diameter;
    return true;
  }

  bool flat() {
    if (!findSides()) return false;
    bool any = false;
    for (const ir::Axis axis : {ir::Axis::X, ir::Axis::Y}) {
      const ExpressionPtr width = value(ArgumentRole::Width, axis);
      if (width == nullptr) continue;
      any = true;
      pair(along(axis), width);
      foundHere(axis);
      out_.values[ir::ResultName::Size] = width;
    }
    return any;
  }

  // Two touches of one face, the way between them around the middle.
  bool angle() {
    for (const ir::Axis normal : {ir::Axis::X, ir::Axis::Y}) {
      const ir::Axis beside = normal == ir::Axis::X ? ir::Axis::Y : ir::Axis::X;
      const ir::CycleArgument* const target = find(ArgumentRole::Target, normal);
      const ExpressionPtr given = value(ArgumentRole::Spacing, beside);
      if (target == nullptr || !target->frame || given == nullptr) continue;
      const ExpressionPtr spacing = ir::simplify(ir::unary(ir::UnaryOp::Absolute, given, given->range));
      const Way way = along(beside);
      go(way, negated(half(spacing)));
      face(normal, target->value, *target->frame);
      go(way, spacing);
      face(normal, target->value, *target->frame);
      go(way, negated(half(spacing)));
      const ExpressionPtr expected = value(ArgumentRole::FaceAngle);
      out_.values[ir::ResultName::Angle] =
          expected ? expected : ir::constant(normal == ir::Axis::X ? kRightAngle : 0);
      return true;
    }
    return false;
  }

  bool angledFace() {
    const ExpressionPtr direction = value(ArgumentRole::Direction), expected = value(ArgumentRole::Distance);
    if (direction == nullptr || expected == nullptr) return false;
    const Way way = atAngle(direction);
    touch(way, expected);
    const auto found = [&](ir::Axis axis, const ExpressionPtr& part) {
      out_.places[position(axis)] = {part ? times(part, expected) : ir::constant(0), ir::Frame::Here,
                                     nullptr};
    };
    found(ir::Axis::X, way.x);
    found(ir::Axis::Y, way.y);
    return true;
  }

  bool angledFlat() {
    const ExpressionPtr direction = value(ArgumentRole::Direction), width = value(ArgumentRole::Width);
    if (direction == nullptr || width == nullptr || !findSides()) return false;
    pair(atAngle(direction), width);
    for (const ir::Axis axis : {ir::Axis::X, ir::Axis::Y})
      foundHere(axis);
    out_.values[ir::ResultName::Size] = width;
    return true;
  }

  bool threePoints() {
    const ExpressionPtr diameter = value(ArgumentRole::Diameter);
    if (diameter == nullptr || !findSides()) return false;
    for (const ArgumentRole role :
         {ArgumentRole::FirstAngle, ArgumentRole::SecondAngle, ArgumentRole::ThirdAngle}) {
      const ExpressionPtr direction = value(role);
      if (direction == nullptr) return false;
      side(atAngle(direction), half(diameter));
    }
    for (const ir::Axis axis : {ir::Axis::X, ir::Axis::Y})
      foundHere(axis);
    out_.values[ir::ResultName::Size] = diameter;
    return true;
  }

  const ir::CallCycle& cycle_;
  const PathState& now_;
  const ir::Origin& origin_;
  ExpressionPtr depth_, beside_, gap_; // gap_: from the middle of the ball, with the sign of beside_
  DrawnCycle out_;
};

} // namespace

std::optional<DrawnCycle> drawnCycle(const ir::CallCycle& cycle, const PathState& now,
                                     const ir::Origin& origin) {
  return Drawing(cycle, now, origin).draw();
}

} // namespace dotek::backends::gibbs
