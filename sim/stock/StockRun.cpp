#include "sim/stock/StockRun.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dotek::sim {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

// The upper surface of the part at a place, from `above` down to `below`: steps as long as nothing is near.
// No number: a wall along Z is in the way of finding it.
double topOf(const Part& part, double x, double y, double above, double below) {
  constexpr int kMostSteps = 2000;
  constexpr double kLeastStep = 0.001;
  double z = above, before = above;
  for (int i = 0; i < kMostSteps; ++i) {
    const double distance = part.distance({x, y, z});
    if (distance < 0) {
      double low = z, high = before;
      for (int turn = 0; turn < 50 && high - low > 1e-10; ++turn) {
        const double middle = (low + high) / 2;
        (part.distance({x, y, middle}) < 0 ? low : high) = middle;
      }
      return (low + high) / 2;
    }
    if (z < below) return below;
    before = z;
    z -= std::max(distance, kLeastStep);
  }
  return kUnknown;
}

// Square to the surface of the part.
double marginAt(const Part& part, const Point3& surface, double top) {
  constexpr double kSame = 1e-9;
  const double over = surface.z - top;
  if (std::abs(over) < kSame) return 0;
  const Point3 up{surface.x, surface.y, top};
  const Part::Nearest there = part.nearest(surface);
  if (over > 0) return std::max(0.0, there.distance);
  const Point3 normal = part.nearest(up).normal;
  const bool sameSide = there.distance < 0 && there.normal.dot(normal) > 0.5;
  return sameSide ? there.distance : over * std::abs(normal.z);
}

// As a needle, about: whatever the tool is, it cuts.
bool comesInto(const StockBlock& block, const Point3& from, const Point3& to) {
  const auto meets = [](double a, double b, double least, double most) {
    return std::min(a, b) < most && std::max(a, b) > least;
  };
  return meets(from.x, to.x, block.least.x, block.most.x) &&
         meets(from.y, to.y, block.least.y, block.most.y) && meets(from.z, to.z, block.least.z, block.most.z);
}

} // namespace

const StockTool* StockRun::toolOf(std::uint32_t number) const {
  // A program that calls no tool runs with the one that there is.
  if (number == 0 && file_.tools.size() == 1) return &file_.tools.front();
  return file_.find(number);
}

std::optional<StockRun::Found> StockRun::moved(const MachineMotion& motion, std::uint32_t tool,
                                               double lengthInForce) {
  if (!motion.known) {
    ++lost_;
    return std::nullopt;
  }
  const StockTool* const cutter = toolOf(tool);
  const double length = cutter != nullptr && cutter->length ? *cutter->length : lengthInForce;
  const auto tip = [&](const Position& gauge) {
    return Point3{gauge[0], gauge[1], gauge[2] - length} - file_.zero;
  };
  const Point3 from = tip(motion.from), to = tip(motion.to);
  if (cutter == nullptr) {
    if (unknown_.contains(tool) || !comesInto(file_.block, from, to)) return std::nullopt;
    unknown_.insert(tool);
    return Found{Event::UnknownTool, tool, 0, to};
  }
  const StockMap::Cut cut = map_.cut(cutter->shape, from, to);
  constexpr double kTouch = 1e-6; // mm: it runs along what was cut before
  if (motion.kind != MotionKind::Rapid || cut.deepest <= kTouch) return std::nullopt;
  return Found{Event::Rapid, tool, cut.deepest, cut.at};
}

std::optional<StockMargin> StockRun::margin() const {
  if (file_.part.isEmpty()) return std::nullopt;
  StockMargin out;
  out.cells.reserve(map_.columns() * map_.rows());
  const double above = map_.block().most.z + 1, below = map_.block().least.z;
  for (std::size_t row = 0; row < map_.rows(); ++row)
    for (std::size_t column = 0; column < map_.columns(); ++column) {
      const Point3 at{map_.x(column), map_.y(row), map_.height(column, row)};
      const double top = topOf(file_.part, at.x, at.y, above, below);
      const double margin = std::isfinite(top) ? marginAt(file_.part, at, std::max(top, below)) : kUnknown;
      out.cells.push_back(margin);
      if (!std::isfinite(margin)) {
        ++out.unknown;
        continue;
      }
      if (margin > file_.tolerance) ++out.over;
      if (margin < -file_.tolerance) ++out.under;
      if (margin > out.most) {
        out.most = margin;
        out.mostAt = at;
      }
      if (margin < out.least) {
        out.least = margin;
        out.leastAt = at;
      }
    }
  return out;
}

} // namespace dotek::sim
