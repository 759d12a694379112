// Bodies in machine coordinates that a probe's ball touches: exact geometry for tests.
#pragma once

#include "sim/machine/Machine.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

namespace dotek::tests {

using Vector = std::array<double, 3>;

// The ball's centre moves along a straight line. A body answers with the share of the path at which the ball
// touches it. Bodies are inflated by the ball with sharp edges, so tests touch away from edges.
class ContactWorld final : public sim::SkipSignal {
public:
  // The machine's position is that of the ball's lowest point where `tip`, else of its centre; tool length 0.
  explicit ContactWorld(double ballRadius, bool tip = true)
      : ball_(ballRadius), rise_(tip ? ballRadius : 0) {}

  // Matter on the side away from `normal`, which has length 1.
  void halfSpace(Vector point, Vector normal) {
    bodies_.push_back([=, this](const Vector& from, const Vector& way) {
      Span inside;
      clip(inside, dot(minus(from, point), normal) - ball_, dot(way, normal));
      return entry(inside, way);
    });
  }
  // A face along Z whose normal points at `degrees` from +X.
  void wall(double x, double y, double degrees) {
    const double a = degrees * std::numbers::pi / 180;
    halfSpace({x, y, 0}, {std::cos(a), std::sin(a), 0});
  }
  // Solid, sides `degrees` from the axes, from the floor up to `top`.
  void box(double x, double y, double width, double depth, double top, double degrees = 0) {
    const double a = degrees * std::numbers::pi / 180;
    const Vector u{std::cos(a), std::sin(a), 0}, v{-std::sin(a), std::cos(a), 0};
    bodies_.push_back([=, this](const Vector& from, const Vector& way) {
      const Vector d = minus(from, {x, y, 0});
      Span inside;
      for (const auto& [axis, half] : {std::pair{u, width / 2}, std::pair{v, depth / 2}}) {
        clip(inside, dot(d, axis) - half - ball_, dot(way, axis));
        clip(inside, -dot(d, axis) - half - ball_, -dot(way, axis));
      }
      clip(inside, from[2] - top - ball_, way[2]);
      return entry(inside, way);
    });
  }
  // Solid, upright, up to `top`.
  void boss(double x, double y, double diameter, double top) {
    bodies_.push_back([=, this](const Vector& from, const Vector& way) {
      Span inside = within(from, way, x, y, diameter / 2 + ball_);
      clip(inside, from[2] - top - ball_, way[2]);
      return entry(inside, way);
    });
  }
  // A hole through everything.
  void bore(double x, double y, double diameter) {
    bodies_.push_back([=, this](const Vector& from, const Vector& way) -> std::optional<double> {
      const Span free = within(from, way, x, y, diameter / 2 - ball_);
      if (free.last <= free.first || free.first > kSlack || free.last < -kSlack) return 0.0;
      if (free.last > 1) return std::nullopt;
      return std::max(free.last, 0.0);
    });
  }

  std::optional<double> contact(const sim::SkipMove& move) override {
    ++moves;
    Vector from{}, way{};
    for (std::size_t i = 0; i < 3; ++i) {
      from[i] = move.machineFrom[i] + (i == 2 ? rise_ : 0);
      way[i] = move.machineTo[i] - move.machineFrom[i];
    }
    std::optional<double> first;
    for (const auto& body : bodies_) {
      const std::optional<double> at = body(from, way);
      if (at && (!first || *at < *first)) first = at;
    }
    return first;
  }

  int moves = 0;

private:
  // Shares of the path between which the ball is within something.
  struct Span {
    double first = -std::numeric_limits<double>::infinity();
    double last = std::numeric_limits<double>::infinity();
  };
  static constexpr double kSlack = 1e-7; // the machine rounds to a nanometre

  static double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
  static Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

  // Keeps where value + rate * t <= 0.
  static void clip(Span& span, double value, double rate) {
    if (std::abs(rate) < 1e-12) {
      if (value > 0) span.last = span.first = -std::numeric_limits<double>::infinity();
      return;
    }
    const double at = -value / rate;
    if (rate < 0)
      span.first = std::max(span.first, at);
    else
      span.last = std::min(span.last, at);
  }
  static Span within(const Vector& from, const Vector& way, double x, double y, double radius) {
    const double dx = from[0] - x, dy = from[1] - y;
    const double a = way[0] * way[0] + way[1] * way[1], b = dx * way[0] + dy * way[1];
    const double c = dx * dx + dy * dy - radius * radius;
    Span out;
    if (a < 1e-18) {
      if (c > 0 || radius < 0) out.last = out.first;
      return out;
    }
    const double root = b * b - a * c;
    if (root < 0 || radius < 0) {
      out.last = out.first;
      return out;
    }
    out.first = (-b - std::sqrt(root)) / a;
    out.last = (-b + std::sqrt(root)) / a;
    return out;
  }
  // Entering, or within already; leaving the surface is no contact.
  static std::optional<double> entry(const Span& inside, const Vector& way) {
    const double length = std::sqrt(dot(way, way));
    const double first = std::max(inside.first, 0.0);
    if (!(inside.last > inside.first) || first > 1 || (inside.last - first) * length < 1e-5)
      return std::nullopt;
    return first;
  }

  double ball_, rise_;
  std::vector<std::function<std::optional<double>(const Vector&, const Vector&)>> bodies_;
};

} // namespace dotek::tests
