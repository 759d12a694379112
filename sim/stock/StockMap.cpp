#include "sim/stock/StockMap.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dotek::sim {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();

std::size_t countOf(double length, double cell) {
  return static_cast<std::size_t>(std::max(1.0, std::ceil(length / cell - 1e-9)));
}

// The lower side of a tool along a straight way, over one place beside it. The square of the distance from
// the axis is a t^2 - 2 b t + c for the share t of the way.
struct Passing {
  double a, b, c;
  double z, rise; // of the tip at the start, and along the way

  double distance(double t) const { return std::sqrt(std::max(0.0, (a * t - 2 * b) * t + c)); }
  double bottom(const CutterShape& tool, double t) const {
    return z + rise * t + tool.bottom(std::min(distance(t), tool.radius()));
  }
};

// The shares of the way on which the place is within the radius. false: on none.
bool within(const Passing& way, double radius, double& first, double& last) {
  const double free = way.c - radius * radius;
  if (way.a <= 0) {
    first = 0;
    last = 1;
    return free <= 0;
  }
  const double root = way.b * way.b - way.a * free;
  if (root < 0) return false;
  first = std::max(0.0, (way.b - std::sqrt(root)) / way.a);
  last = std::min(1.0, (way.b + std::sqrt(root)) / way.a);
  return first <= last;
}

// Of a ball: where its lower side is lowest over the place, by the derivative.
double lowestOfBall(const Passing& way, double radius, double first, double last) {
  if (way.a <= 0) return way.rise < 0 ? last : first;
  const double middle = way.b / way.a;
  const double beside = std::max(0.0, radius * radius - way.c + way.b * way.b / way.a);
  const double off = std::sqrt(way.rise * way.rise * beside / (way.a * (way.a + way.rise * way.rise)));
  return std::clamp(way.rise < 0 ? middle + off : middle - off, first, last);
}

// Of any tool: what is to be made small is convex along the way.
double lowestBySearch(const Passing& way, const CutterShape& tool, double first, double last) {
  constexpr double kGolden = 0.6180339887498949;
  constexpr int kTurns = 60;
  double a = first, b = last;
  double x = b - kGolden * (b - a), y = a + kGolden * (b - a);
  double atX = way.bottom(tool, x), atY = way.bottom(tool, y);
  for (int i = 0; i < kTurns && b - a > 1e-12; ++i) {
    if (atX <= atY) {
      b = y;
      y = x;
      atY = atX;
      x = b - kGolden * (b - a);
      atX = way.bottom(tool, x);
    } else {
      a = x;
      x = y;
      atX = atY;
      y = a + kGolden * (b - a);
      atY = way.bottom(tool, y);
    }
  }
  const double middle = (a + b) / 2;
  double best = middle;
  for (const double end : {first, last})
    if (way.bottom(tool, end) < way.bottom(tool, best)) best = end;
  return best;
}

double lowest(const Passing& way, const CutterShape& tool) {
  double first = 0, last = 1;
  if (!within(way, tool.radius(), first, last)) return kNone;
  double share = 0;
  if (tool.corner <= 0)
    share = way.rise < 0 ? last : first;
  else if (way.rise == 0)
    share = way.a > 0 ? std::clamp(way.b / way.a, first, last) : first;
  else if (tool.corner >= tool.radius())
    share = lowestOfBall(way, tool.radius(), first, last);
  else
    share = lowestBySearch(way, tool, first, last);
  return way.bottom(tool, share);
}

} // namespace

double CutterShape::bottom(double distance) const {
  const double flat = radius() - corner;
  if (distance <= flat) return 0;
  const double out = distance - flat;
  return corner - std::sqrt(std::max(0.0, corner * corner - out * out));
}

StockMap::StockMap(const StockBlock& block)
    : block_(block), columns_(countOf(block.most.x - block.least.x, block.cell)),
      rows_(countOf(block.most.y - block.least.y, block.cell)), heights_(columns_ * rows_, block.most.z) {}

StockMap::Cut StockMap::cut(const CutterShape& tool, const Point3& from, const Point3& to) {
  Cut out;
  if (std::min(from.z, to.z) >= block_.most.z) return out;
  const double reach = tool.radius();
  const auto index = [&](double at, double least, std::size_t count) {
    const double cells = std::floor((at - least) / block_.cell);
    return static_cast<std::size_t>(std::clamp(cells, 0.0, static_cast<double>(count - 1)));
  };
  if (std::max(from.x, to.x) + reach < block_.least.x || std::min(from.x, to.x) - reach > block_.most.x ||
      std::max(from.y, to.y) + reach < block_.least.y || std::min(from.y, to.y) - reach > block_.most.y)
    return out;
  const std::size_t firstColumn = index(std::min(from.x, to.x) - reach, block_.least.x, columns_);
  const std::size_t lastColumn = index(std::max(from.x, to.x) + reach, block_.least.x, columns_);
  const std::size_t firstRow = index(std::min(from.y, to.y) - reach, block_.least.y, rows_);
  const std::size_t lastRow = index(std::max(from.y, to.y) + reach, block_.least.y, rows_);
  const Point3 way = to - from;
  Passing passing{way.x * way.x + way.y * way.y, 0, 0, from.z, way.z};
  double taken = 0;
  for (std::size_t row = firstRow; row <= lastRow; ++row)
    for (std::size_t column = firstColumn; column <= lastColumn; ++column) {
      double& height = heights_[row * columns_ + column];
      if (height <= block_.least.z) continue;
      const double dx = x(column) - from.x, dy = y(row) - from.y;
      passing.b = way.x * dx + way.y * dy;
      passing.c = dx * dx + dy * dy;
      const double left = std::max(lowest(passing, tool), block_.least.z);
      if (left >= height) continue;
      const double depth = height - left;
      if (depth > out.deepest) out = {depth, {x(column), y(row), left}};
      taken += depth;
      height = left;
    }
  removed_ += taken * block_.cell * block_.cell;
  return out;
}

} // namespace dotek::sim
