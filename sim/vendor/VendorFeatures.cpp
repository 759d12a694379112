// What calls do that are statements of the cycle language: a protected move, touches of one surface. Of all
// others a cycle of the library says it (VendorDefinition.cpp).
#include "sim/vendor/VendorRun.h"
#include "stdlib/SearchTravel.h"

#include <cmath>

namespace dotek::sim {

using stdlib::Intent;

namespace {

constexpr double kNothing = 1e-6;
constexpr Direction kDirections[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
constexpr double kObstructed = 7; // #148 of a protected move that was told to raise no alarm

Direction directionOf(ir::Axis axis, double sign) {
  Direction out = kDirections[ir::indexOf(axis)];
  for (double& part : out)
    part *= sign;
  return out;
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
    if (!touch(direction, std::abs(way), centre, stdlib::travelIsSearch(signature_, *target)) ||
        !radius(direction, ball))
      return false;
    if (missed_) return true;
    foundPosition(axis, centre[i] + direction[i] * ball, start_[i] + way);
  }
  return true;
}

bool VendorRun::angledSurface() {
  const Direction direction = directionAt(need(Role::Direction));
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

} // namespace dotek::sim
