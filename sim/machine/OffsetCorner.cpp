#include "sim/machine/OffsetCorner.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace dotek::sim {
namespace {

PlanePoint operator+(PlanePoint a, PlanePoint b) {
  return {a.u + b.u, a.v + b.v};
}
PlanePoint operator-(PlanePoint a, PlanePoint b) {
  return {a.u - b.u, a.v - b.v};
}
PlanePoint operator*(double k, PlanePoint a) {
  return {k * a.u, k * a.v};
}
double dot(PlanePoint a, PlanePoint b) {
  return a.u * b.u + a.v * b.v;
}
double cross(PlanePoint a, PlanePoint b) {
  return a.u * b.v - a.v * b.u;
}
double length(PlanePoint a) {
  return std::hypot(a.u, a.v);
}
PlanePoint unit(PlanePoint a) {
  const double size = length(a);
  return size > 0 ? (1 / size) * a : PlanePoint{};
}
PlanePoint left(PlanePoint a) {
  return {-a.v, a.u};
}

// Of the move where it passes `at`.
PlanePoint direction(const PlaneMove& move, PlanePoint at) {
  if (!move.arc) return unit(move.to - move.from);
  const PlanePoint along = left(unit(at - move.centre));
  return move.clockwise ? -1 * along : along;
}

// Where the offset moves meet, nearest to the corner.
std::optional<PlanePoint> meeting(const PlaneMove& first, const PlaneMove& second, double radius,
                                  PlanePoint corner) {
  const PlanePoint d1 = direction(first, corner), d2 = direction(second, corner);
  const PlanePoint n1 = left(d1), n2 = left(d2);
  if (!first.arc && !second.arc) {
    const double scale = 1 + dot(n1, n2);
    if (scale < 1e-9) return std::nullopt;
    return corner + (radius / scale) * (n1 + n2);
  }
  const auto nearest = [&](PlanePoint a, PlanePoint b) {
    return length(a - corner) <= length(b - corner) ? a : b;
  };
  if (first.arc && second.arc) {
    const double r1 = offsetArcRadius(first, radius), r2 = offsetArcRadius(second, radius);
    const PlanePoint between = second.centre - first.centre;
    const double apart = length(between);
    if (apart < 1e-9) return std::nullopt;
    const double along = (apart * apart + r1 * r1 - r2 * r2) / (2 * apart);
    const double square = r1 * r1 - along * along;
    if (square < -1e-9) return std::nullopt;
    const PlanePoint foot = first.centre + (along / apart) * between;
    const PlanePoint up = (std::sqrt(std::max(square, 0.0)) / apart) * left(between);
    return nearest(foot + up, foot - up);
  }
  const PlaneMove& arc = first.arc ? first : second;
  const PlanePoint d = first.arc ? d2 : d1;
  const PlanePoint on = corner + radius * (first.arc ? n2 : n1);
  const double r = offsetArcRadius(arc, radius);
  const PlanePoint foot = on + dot(arc.centre - on, d) * d;
  const double square = r * r - dot(foot - arc.centre, foot - arc.centre);
  if (square < -1e-9) return std::nullopt;
  const double half = std::sqrt(std::max(square, 0.0));
  return nearest(foot + half * d, foot - half * d);
}

} // namespace

bool isSame(PlanePoint a, PlanePoint b, double tolerance) {
  return length(a - b) <= tolerance;
}

PlanePoint offsetBegin(const PlaneMove& move, double radius) {
  return move.from + radius * left(direction(move, move.from));
}

PlanePoint offsetEnd(const PlaneMove& move, double radius) {
  return move.to + radius * left(direction(move, move.to));
}

double offsetArcRadius(const PlaneMove& arc, double radius) {
  const double own = length(arc.from - arc.centre);
  return arc.clockwise ? own + radius : own - radius;
}

std::optional<OffsetCorner> offsetCorner(const PlaneMove& first, const PlaneMove& second, double radius,
                                         bool round) {
  const PlanePoint corner = first.to;
  const PlanePoint d1 = direction(first, corner), d2 = direction(second, corner);
  const PlanePoint p1 = offsetEnd(first, radius), p2 = offsetBegin(second, radius);
  const double turn = cross(d1, d2), ahead = dot(d1, d2);
  constexpr double kSmooth = 1e-3; // mm: what a CAM rounds is no corner
  if (ahead > 0 && isSame(p1, p2, kSmooth)) {
    const PlanePoint at = corner + radius * unit(left(d1) + left(d2));
    return OffsetCorner{at, false, {}, at};
  }
  if (turn * radius > 0) { // towards the tool
    const std::optional<PlanePoint> at = meeting(first, second, radius, corner);
    if (!at) return std::nullopt;
    return OffsetCorner{*at, false, {}, *at};
  }
  if (round) return OffsetCorner{p1, true, {p2}, p2};
  std::vector<PlanePoint> points;
  if (first.arc) points.push_back(p1);
  constexpr double kRight = -1e-9; // of the cosine
  if (ahead >= kRight) {
    points.push_back(corner + (radius / (1 + ahead)) * (left(d1) + left(d2)));
  } else {
    const double by = std::abs(radius);
    points.push_back(p1 + by * d1);
    points.push_back(p2 - by * d2);
  }
  if (second.arc) points.push_back(p2);
  OffsetCorner out{points.front(), false, {points.begin() + 1, points.end()}, points.back()};
  return out;
}

bool goesBack(const PlaneMove& move, PlanePoint begin, PlanePoint end) {
  constexpr double kLeast = 1e-6; // mm
  if (!move.arc) return dot(end - begin, direction(move, move.to)) < -kLeast;
  constexpr double kTurn = 2 * std::numbers::pi;
  const auto sweep = [&](PlanePoint a, PlanePoint b) {
    const PlanePoint from = a - move.centre, to = b - move.centre;
    const double angle = std::atan2(cross(from, to), dot(from, to)) * (move.clockwise ? -1 : 1);
    return angle < 0 ? angle + kTurn : angle;
  };
  double own = sweep(move.from, move.to);
  if (isSame(move.from, move.to)) own = kTurn;
  const double now = sweep(begin, end);
  // Of the angles that are the same but for whole turns, the one nearest to that of the program.
  const double best = now + kTurn * std::round((own - now) / kTurn);
  return best * length(end - move.centre) < -kLeast;
}

} // namespace dotek::sim
