// The surfaces of examples/pocket-6m, and how far a trace of `sim` stays from them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace dotek::tests::pocket {

using Point = std::array<double, 3>; // in G56, mm

constexpr double kBall = 16.0;
inline double rad(double degrees) {
  return degrees * std::numbers::pi / 180.0;
}

// A wall seen across: d before its face, h above the top of the rib, c the cosine between their normals.
inline double wedge(double d, double h, double c) {
  if (h - d * c <= 0) return d;
  if (d - h * c <= 0) return h;
  return std::sqrt((d * d + h * h - 2 * c * d * h) / (1 - c * c));
}

// Distances of a point from each surface, below 0 in the material.
struct Surfaces {
  double y = 0;      // of the ball's centre in the corner of cylinder and floor
  double z = 0;      //
  double left = 0;   // distance of the wall at 66.536 degrees from the eye's centre
  double right = 0;  // of the wall at 93.91 degrees
  double eye = 40.0; // radius

  Surfaces() {
    const double t = std::tan(rad(39)), c = -(54 - kBall) / std::cos(rad(39)), r = 64 + kBall, a = 1 + t * t;
    z = (c + std::sqrt(c * c - a * (c * c - t * t * r * r))) / a;
    y = (z - c) / t;
    const double x = (y - 177.8 - (30 - kBall) / std::sin(rad(20))) / std::tan(rad(70));
    left = std::sin(rad(66.536)) * x - std::cos(rad(66.536)) * (y - 177.8) - kBall;
    right = -std::cos(rad(3.91)) * (30 - kBall) - std::sin(rad(3.91)) * (y - 177.8) - kBall;
  }

  static double top(const Point& p) { return p[2] * std::cos(rad(12)) - p[1] * std::sin(rad(12)) - 64; }
  static double across(const Point& p) {
    return std::cos(rad(20)) * p[0] - std::sin(rad(20)) * (p[1] - 177.8);
  }
  static double corner() { return std::sin(rad(20)) * std::sin(rad(12)); }

  double operator()(std::string_view name, const Point& p) const {
    if (name == "cylinder") return std::hypot(p[1], p[2]) - 64;
    if (name == "floor") return (p[2] - std::tan(rad(39)) * p[1]) * std::cos(rad(39)) + 54;
    if (name == "outside") return wedge(-across(p) - 40, top(p), -corner());
    if (name == "wall 70") return wedge(across(p) + 30, top(p), corner());
    if (name == "wall X30") return wedge(30 - p[0], top(p), 0);
    if (name == "wall 66")
      return wedge(std::sin(rad(66.536)) * p[0] - std::cos(rad(66.536)) * (p[1] - 177.8) - left, top(p),
                   std::cos(rad(66.536)) * std::sin(rad(12)));
    if (name == "wall 93")
      return wedge(-std::cos(rad(3.91)) * p[0] - std::sin(rad(3.91)) * (p[1] - 177.8) - right, top(p),
                   std::sin(rad(3.91)) * std::sin(rad(12)));
    return std::hypot(p[0], p[1] - 177.8) - eye; // "eye"
  }
};

struct Move {
  bool rapid = false, arc = false;
  double feed = 0;
  Point from = {}, to = {};
  std::vector<Point> points; // at most 0.25 apart
};

// The moves of each program of the family, from its M41 to its M80.
inline std::vector<std::vector<Move>> movesOf(const std::string& trace) {
  std::vector<std::vector<Move>> out;
  std::istringstream lines(trace);
  Point at = {};
  bool open = false;
  for (std::string line; std::getline(lines, line);) {
    if (line == "auxiliary M41") out.emplace_back();
    if (line == "auxiliary M41" || line == "auxiliary M80") open = line.ends_with("M41");
    std::istringstream words(line);
    std::string kind, word;
    words >> kind;
    Move move;
    move.rapid = kind == "rapid";
    move.arc = kind.starts_with("arc-");
    if (kind == "system") { // the same place in another system
      words >> word;
      while (words >> word)
        if (word[0] >= 'X' && word[0] <= 'Z') at[word[0] - 'X'] = std::stod(word.substr(1));
      continue;
    }
    if (!move.rapid && !move.arc && kind != "feed") continue;
    std::string plane;
    if (move.arc) words >> plane;
    Point to = at;
    std::array<double, 2> centre = {};
    while (words >> word) {
      if (word == "centre")
        words >> centre[0] >> centre[1];
      else if (word[0] >= 'X' && word[0] <= 'Z')
        to[word[0] - 'X'] = std::stod(word.substr(1));
      else if (word[0] == 'F')
        move.feed = std::stod(word.substr(1));
    }
    move.from = at;
    move.to = to;
    const std::size_t u = plane == "yz" ? 1 : 0, v = u + 1, w = 3 - u - v;
    double length = std::hypot(to[0] - at[0], to[1] - at[1], to[2] - at[2]);
    double begin = 0, turn = 0, radius = 0;
    if (move.arc) {
      begin = std::atan2(at[v] - centre[1], at[u] - centre[0]);
      turn = std::atan2(to[v] - centre[1], to[u] - centre[0]) - begin;
      const double whole = 2 * std::numbers::pi;
      if (kind == "arc-ccw" && turn <= 0) turn += whole;
      if (kind == "arc-cw" && turn >= 0) turn -= whole;
      radius = std::hypot(at[u] - centre[0], at[v] - centre[1]);
      length = std::max(length, radius * std::abs(turn));
    }
    const int steps = std::max(1, static_cast<int>(std::ceil(length / 0.25)));
    for (int i = 0; i <= steps; ++i) {
      const double part = static_cast<double>(i) / steps;
      Point p = {};
      for (std::size_t k = 0; k < 3; ++k)
        p[k] = at[k] + (to[k] - at[k]) * part;
      if (move.arc) {
        p[u] = centre[0] + radius * std::cos(begin + turn * part);
        p[v] = centre[1] + radius * std::sin(begin + turn * part);
        p[w] = at[w] + (to[w] - at[w]) * part;
      }
      move.points.push_back(p);
    }
    at = to;
    if (open) out.back().push_back(move);
  }
  return out;
}

constexpr double kClear = 150.0; // above it nothing is near

// With a sign: the value that is farthest from 0.
inline void widest(double& found, double value) {
  if (std::abs(value) > std::abs(found)) found = value;
}

inline Point centreOf(const Point& tip, double ball) {
  return {tip[0], tip[1], tip[2] + ball};
}

// How deep the ball goes into one of the surfaces, below 0: into the part.
inline double deepest(const Surfaces& part, const std::vector<Move>& moves,
                      const std::vector<std::string_view>& surfaces, double ball = kBall) {
  double out = 1e9;
  for (const Move& move : moves)
    for (const Point& p : move.points)
      if (p[2] < kClear)
        for (const std::string_view name : surfaces)
          out = std::min(out, part(name, centreOf(p, ball)) - ball);
  return out;
}

// The passes: moves at the feed of the cut, without the way down into the corner.
inline std::vector<Move> passesOf(const std::vector<Move>& moves, double feed, bool down) {
  std::size_t first = 0;
  if (down) {
    while (first < moves.size() && !moves[first].arc)
      ++first;
    first = first == 0 ? 0 : first - 1;
  }
  std::vector<Move> out;
  for (std::size_t i = first; i < moves.size(); ++i) {
    const Move& move = moves[i];
    const bool vertical = !move.arc && move.from[0] == move.to[0] && move.from[1] == move.to[1];
    if (!move.rapid && move.feed == feed && !vertical) out.push_back(move);
  }
  return out;
}

// The nearest of these surfaces, less the radius: how far the ball is off it, the worst of the passes.
inline double offSurface(const Surfaces& part, const std::vector<Move>& passes,
                         const std::vector<std::string_view>& surfaces, double ball = kBall) {
  double out = 0;
  const auto nearest = [&](const Point& p) {
    double found = 1e9;
    for (const std::string_view name : surfaces)
      found = std::min(found, part(name, centreOf(p, ball)) - ball);
    return found;
  };
  for (const Move& move : passes)
    for (const Point& p : move.points)
      widest(out, nearest(p));
  return out;
}

// The same at the ends of the passes along X: off the nearest wall.
inline double offWalls(const Surfaces& part, const std::vector<Move>& passes,
                       const std::vector<std::string_view>& walls, double ball = kBall) {
  double out = 0;
  for (const Move& move : passes) {
    if (move.arc || move.from[1] != move.to[1]) continue;
    double found = 1e9;
    for (const std::string_view name : walls)
      found = std::min(found, part(name, centreOf(move.to, ball)) - ball);
    widest(out, found);
  }
  return out;
}

// A flat mill: how near the edge of its end comes to each surface.
inline double flatMill(const Surfaces& part, const std::vector<Move>& moves, double radius,
                       std::string_view name) {
  double out = 1e9;
  for (const Move& move : moves)
    for (const Point& p : move.points) {
      if (p[2] > kClear) continue;
      double found = 0;
      if (name == "cylinder") {
        const double y = p[1] > radius ? p[1] - radius : p[1] < -radius ? p[1] + radius : 0;
        found = std::hypot(y, p[2]) - 64;
      } else if (name == "floor") {
        found = part(name, {p[0], p[1] + radius, p[2]});
      } else {
        found = part(name, {p[0], p[1], -1000}) - radius; // the walls are upright
      }
      out = std::min(out, found);
    }
  return out;
}

} // namespace dotek::tests::pocket
