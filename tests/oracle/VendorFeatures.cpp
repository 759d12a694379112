// What each kind of call touches, and what it finds.
#include "ir/Arithmetic.h"
#include "tests/oracle/VendorRun.h"

#include <cmath>

namespace dotek::oracle {

using namespace dotek::sim;

using stdlib::Intent;

namespace {

constexpr double kNothing = 1e-6;
constexpr Direction kDirections[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
constexpr double kRightAngle = 90, kHalfTurn = 180;
constexpr double kObstructed = 7; // #148 of a protected move that was told to raise no alarm

Direction directionOf(ir::Axis axis, double sign) {
  Direction out = kDirections[ir::indexOf(axis)];
  for (double& part : out)
    part *= sign;
  return out;
}

// Multiples of 90 degrees are exact.
Direction directionOf(double angle) {
  return {ir::cosine(angle, ir::AngleUnit::Degrees).value, ir::sine(angle, ir::AngleUnit::Degrees).value, 0};
}

} // namespace

void VendorRun::foundPosition(ir::Axis axis, double measured, double expected) {
  constexpr Output kPositions[] = {Output::PositionX, Output::PositionY, Output::PositionZ};
  constexpr Output kErrors[] = {Output::ErrorX, Output::ErrorY, Output::ErrorZ};
  const std::size_t i = ir::indexOf(axis);
  found_[kPositions[i]] = measured;
  // Where the call names the coordinate that the feature gets, that one is expected.
  error_[i] = measured - value(Role::Nominal, axis).value_or(expected);
  found_[kErrors[i]] = measured - expected;
}

void VendorRun::foundSize(double measured, double expected) {
  size_ = measured;
  expectedSize_ = expected;
}

bool VendorRun::protectedMove() {
  const auto& feedVariable = set_.probing.feedVariable;
  if (const auto feed = value(Role::Feed)) {
    if (!(*feed > 0)) return meaningless("what it does with a feed that is not above 0 is in no source");
    feed_ = *feed;
  } else if (feedVariable) {
    const std::optional<double> kept = machine_.read(*feedVariable);
    if (!kept) return false;
    if (isNull(*kept) || *kept == 0) return alarm(stdlib::MacroAlarm::NoFeed);
    feed_ = *kept;
  }
  Position end = start_;
  for (const ir::Axis axis : ir::kAxes) {
    const auto* target = argument(Role::Target, axis);
    if (target == nullptr) continue;
    const std::size_t i = ir::indexOf(axis);
    end[i] = *value(Role::Target, axis) + (target->frame == ir::Frame::Here ? start_[i] : 0);
  }
  const std::optional<bool> contact = machine_.probeTo(end, true);
  if (!contact) return false;
  const Position& now = machine_.position();
  const bool obstructed =
      *contact && std::hypot(now[0] - end[0], now[1] - end[1], now[2] - end[2]) > kNothing;
  found_[Output::OutOfTolerance] = obstructed ? kObstructed : 0;
  if (obstructed && value(Role::FlagOnly).value_or(0) != 1) return alarm(stdlib::MacroAlarm::PathObstructed);
  return true;
}

bool VendorRun::surface() {
  for (const ir::Axis axis : ir::kAxes) {
    const auto* target = argument(Role::Target, axis);
    if (target == nullptr) continue;
    const std::size_t i = ir::indexOf(axis);
    const bool travel = target->frame == ir::Frame::Here;
    const double way = *value(Role::Target, axis) - (travel ? 0 : start_[i]);
    if (std::abs(way) < kNothing)
      return meaningless("which way the surface lies is not known: the probe is there");
    const Direction direction = directionOf(axis, way > 0 ? 1 : -1);
    Position centre;
    double ball = 0;
    if (!touch(direction, std::abs(way), centre, travel) || !radius(direction, ball)) return false;
    if (missed_) return true;
    foundPosition(axis, centre[i] + direction[i] * ball, start_[i] + way);
  }
  return true;
}

// Four touches: along X, then along Y through the middle of the first two, which is where the size is true.
bool VendorRun::round() {
  const double diameter = need(Role::Diameter);
  if (!findSides()) return false;
  Position middle = start_;
  double size = 0;
  for (const ir::Axis axis : {ir::Axis::X, ir::Axis::Y}) {
    double offset = 0;
    if (!touchPair(middle, directionOf(axis, 1), diameter, offset, size)) return false;
    const std::size_t i = ir::indexOf(axis);
    middle[i] += offset;
    foundPosition(axis, middle[i], start_[i]);
    if (!watched(middle)) return false;
  }
  foundSize(size, diameter);
  return true;
}

bool VendorRun::flat() {
  if (!findSides()) return false;
  for (const ir::Axis axis : ir::kAxes) {
    const auto width = value(Role::Width, axis);
    if (!width) continue;
    double offset = 0, size = 0;
    if (!touchPair(start_, directionOf(axis, 1), *width, offset, size)) return false;
    foundPosition(axis, start_[ir::indexOf(axis)] + offset, start_[ir::indexOf(axis)]);
    foundSize(size, *width);
  }
  return true;
}

// Without second touches the faces count as parallel to the axes.
bool VendorRun::innerCorner() {
  return surface();
}

bool VendorRun::faceAngle() {
  for (const ir::Axis normal : {ir::Axis::X, ir::Axis::Y}) {
    const auto target = value(Role::Target, normal);
    if (!target) continue;
    const ir::Axis face = normal == ir::Axis::X ? ir::Axis::Y : ir::Axis::X;
    const std::size_t n = ir::indexOf(normal), f = ir::indexOf(face);
    const double spacing = std::abs(value(Role::Spacing, face).value_or(0));
    const double way = *target - start_[n];
    if (spacing < kNothing) return meaningless("two touches without a distance tell no angle");
    if (std::abs(way) < kNothing)
      return meaningless("which way the face lies is not known: the probe is there");
    const double expected = value(Role::FaceAngle).value_or(normal == ir::Axis::X ? kRightAngle : 0);
    std::array<Position, 2> touched;
    for (std::size_t i = 0; i < 2; ++i) {
      Position from = start_;
      from[f] += (i == 0 ? -0.5 : 0.5) * spacing;
      if (!watched(from) || !touch(directionOf(normal, way > 0 ? 1 : -1), std::abs(way), touched[i]))
        return false;
    }
    const ir::Computed angle =
        ir::direction(touched[1][0] - touched[0][0], touched[1][1] - touched[0][1], ir::AngleUnit::Degrees);
    if (!angle.ok()) return notKnown("both touches are at one place");
    // A face has two directions: the one nearer to the expected.
    double error = std::remainder(angle.value - expected, kHalfTurn);
    if (error == -kRightAngle) error = kRightAngle;
    found_[Output::Angle] = expected + error;
    found_[Output::AngleError] = error;
    angleError_ = error;
  }
  return true;
}

bool VendorRun::angledSurface() {
  const Direction direction = directionOf(need(Role::Direction));
  const double expected = need(Role::Distance);
  Position centre;
  double ball = 0;
  if (!touch(direction, expected, centre) || !radius(direction, ball)) return false;
  if (missed_) return true;
  for (const ir::Axis axis : {ir::Axis::X, ir::Axis::Y}) {
    const std::size_t i = ir::indexOf(axis);
    foundPosition(axis, centre[i] + direction[i] * ball, start_[i] + direction[i] * expected);
  }
  return true;
}

bool VendorRun::angledFlat() {
  const Direction direction = directionOf(need(Role::Direction));
  const double width = need(Role::Width);
  double offset = 0, size = 0;
  if (!findSides() || !touchPair(start_, direction, width, offset, size)) return false;
  for (const ir::Axis axis : {ir::Axis::X, ir::Axis::Y}) {
    const std::size_t i = ir::indexOf(axis);
    foundPosition(axis, start_[i] + direction[i] * offset, start_[i]);
  }
  foundSize(size, width);
  return true;
}

// The circle through the ball's three places, and the ball beside it.
bool VendorRun::threePoints() {
  const double diameter = need(Role::Diameter);
  if (!(diameter > 0)) return meaningless("a size that is not above 0");
  if (!findSides()) return false;
  std::array<Position, 3> p;
  constexpr Role kAngles[] = {Role::FirstAngle, Role::SecondAngle, Role::ThirdAngle};
  double ball = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Direction direction = directionOf(need(kAngles[i]));
    if (!touchSide(start_, direction, diameter / 2, p[i]) || !radius(direction, ball)) return false;
  }
  if (radiusX_ != radiusY_ || vectors_)
    return notKnown("how the calibrated radii count in an oblique direction is in no source");
  // From the first point, so that little is lost.
  const double bx = p[1][0] - p[0][0], by = p[1][1] - p[0][1];
  const double cx = p[2][0] - p[0][0], cy = p[2][1] - p[0][1];
  const double twice = 2 * (bx * cy - by * cx);
  if (std::abs(twice) < kNothing) return meaningless("three touches on one line tell no circle");
  const double b = bx * bx + by * by, c = cx * cx + cy * cy;
  const double ux = (cy * b - by * c) / twice, uy = (bx * c - cx * b) / twice;
  foundPosition(ir::Axis::X, p[0][0] + ux, start_[0]);
  foundPosition(ir::Axis::Y, p[0][1] + uy, start_[1]);
  foundSize(2 * std::hypot(ux, uy) + (outside_ ? -2 : 2) * ball, diameter);
  return true;
}

} // namespace dotek::oracle
