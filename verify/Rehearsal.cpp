#include "verify/Rehearsal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace dotek::verify {

namespace {

constexpr double kMostShift = 0.3, kMostTurn = 0.3;
constexpr double kNoWay = 1e-6;

bool isBare(const Measure& measure) {
  return measure.nominal.empty() && (measure.end - measure.start).length() > kNoWay;
}

sim::Point3 directionOf(const Measure& bare) {
  const sim::Point3 way = bare.end - bare.start;
  return way * (1 / way.length());
}

std::array<double, 3> parts(const sim::Point3& p) {
  return {p.x, p.y, p.z};
}

} // namespace

std::vector<Touch> touchesOf(const Record& rehearsal, double ballRadius) {
  std::vector<Touch> out;
  for (const Measure& measure : rehearsal.measures) {
    out.insert(out.end(), measure.nominal.begin(), measure.nominal.end());
    if (!isBare(measure)) continue;
    const sim::Point3 direction = directionOf(measure);
    Touch touch{measure.end, direction};
    if (std::abs(direction.z) < 0.5) {
      // Met by the ball's side.
      touch.point = touch.point + direction * ballRadius;
      touch.point.z += ballRadius;
    }
    out.push_back(touch);
  }
  return out;
}

PartError drawError(const Record& rehearsal, double ballRadius, Random& random) {
  double most = std::min(kMostShift, ballRadius / 3);
  std::array<bool, 3> up{}, down{};
  bool bare = false;
  for (const Measure& measure : rehearsal.measures) {
    if (!isBare(measure)) continue;
    bare = true;
    most = std::min(most, (measure.end - measure.start).length() / 3);
    if (measure.aim && (*measure.aim - measure.end).length() > 2 * kMostShift) continue;
    const std::array<double, 3> way = parts(directionOf(measure));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      up[axis] = up[axis] || way[axis] > 1e-9;
      down[axis] = down[axis] || way[axis] < -1e-9;
    }
  }
  std::array<double, 3> shift{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double size = random.between(0.1, 1) * most;
    const bool plus = random.chance(0.5);
    if (up[axis] && down[axis]) continue; // whichever way, one of them would not arrive
    const double sign = up[axis] ? -1 : down[axis] ? 1 : plus ? 1 : -1;
    // Never a whole number of thousandths, as limits are: rounding alone would decide which side it is on.
    shift[axis] = sign * (std::trunc(size * 1000) + 0.5) / 1000;
  }
  PartError out;
  out.shift = {shift[0], shift[1], shift[2]};
  if (bare) return out;
  double arm = 1;
  const std::vector<Touch> touches = touchesOf(rehearsal, ballRadius);
  for (const Touch& one : touches)
    for (const Touch& other : touches)
      arm = std::max(arm, std::hypot(one.point.x - other.point.x, one.point.y - other.point.y));
  const double turn = std::min(kMostTurn, most / arm * 180 / std::numbers::pi);
  out.turn = std::round(random.between(-turn, turn) * 1000) / 1000;
  return out;
}

} // namespace dotek::verify
