#include "verify/DrawnPath.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

namespace dotek::verify {
namespace {

using sim::Part;
using sim::PartBuilder;
using sim::Point3;

constexpr double kSame = 1e-6;   // mm: places that are meant to be one
constexpr double kMiddle = 1e-5; // mm: where lines meet that are known as exactly as that
constexpr double kBeside = 2.5;  // mm of a face beside the ball: more than an error moves the contact
constexpr double kBehind = 2;    // mm of material after a search that finds nothing
constexpr double kRim = 10;      // mm of a plate around its bore
constexpr double kLeast = 0.35;  // mm of a face beside the ball's centre: an error moves it by no more
constexpr double kMeets = 0.01;  // mm that the ball gets into a face before it is in its way

bool isSame(const Point3& a, const Point3& b) {
  return (a - b).length() <= kSame;
}

// Each touch once; a second one of the same place adds no surface.
std::vector<Touch> distinct(const std::vector<Touch>& touches) {
  std::vector<Touch> out;
  for (const Touch& touch : touches) {
    const bool known = std::any_of(out.begin(), out.end(), [&](const Touch& other) {
      return isSame(other.point, touch.point) && isSame(other.direction, touch.direction);
    });
    if (!known) out.push_back(touch);
  }
  return out;
}

Point3 middleOf(const std::vector<Touch>& touches) {
  const std::vector<Touch> each = distinct(touches);
  Point3 sum;
  for (const Touch& touch : each)
    sum = sum + touch.point;
  return sum * (1 / static_cast<double>(std::max<std::size_t>(each.size(), 1)));
}

// Two touches on one line, in opposite directions.
struct Pair {
  Point3 middle;
  Point3 direction; // of one of them
  double half = 0;  // of the path from one to the other
  bool outward = true;
};

class Shapes {
public:
  Shapes(const std::vector<Touch>& touches, double ballRadius, double reach)
      : middle_(middleOf(touches)), all_(touches), radius_(ballRadius), beside_(ballRadius + kBeside),
        behind_(reach + kBehind) {
    std::vector<Touch> rest = distinct(touches);
    takeCircles(rest);
    std::vector<Pair> pairs = takePairs(rest);
    takeRounds(pairs, rest);
    if (pairs.size() + rest.size() > PartBuilder::kMostShapes) {
      tooMany_ = true; // to fit each of them beside all others would be in vain
      return;
    }
    divideRounds();
    addBores();
    for (const Pair& pair : pairs)
      addPair(pair);
    for (const Touch& touch : rest)
      addBlock(touch.point, touch.direction, behind_);
  }

  std::optional<Part> finish() {
    if (tooMany_) return std::nullopt;
    std::string fault;
    const std::unique_ptr<Part> part = builder_.finish(fault);
    if (!part) return std::nullopt;
    return part->placed({middle_, {}});
  }

private:
  // A bore or a boss of three or more touches that look from or to one middle, one of them at an angle to the
  // axes.
  void takeCircles(std::vector<Touch>& rest) {
    for (std::size_t i = 0; i < rest.size(); ++i)
      for (std::size_t k = i + 1; k < rest.size(); ++k) {
        const std::optional<Pair> circle = circleOf(rest[i], rest[k]);
        if (!circle) continue;
        const auto belongs = [&](const Touch& touch) { return liesOn(*circle, touch); };
        if (std::count_if(rest.begin(), rest.end(), belongs) < 3 ||
            std::none_of(rest.begin(), rest.end(),
                         [&](const Touch& touch) { return belongs(touch) && isOblique(touch); }))
          continue;
        double low = rest[i].point.z, high = low;
        for (const Touch& touch : rest) {
          if (!belongs(touch)) continue;
          low = std::min(low, touch.point.z);
          high = std::max(high, touch.point.z);
        }
        std::erase_if(rest, belongs);
        addRound(*circle, low - kFaceHalf, circle->outward ? high + kFaceHalf : takeTop(*circle, high, rest));
        return takeCircles(rest);
      }
  }
  static bool isOblique(const Touch& touch) {
    return std::abs(touch.direction.x) > kSame && std::abs(touch.direction.y) > kSame;
  }
  // Where the lines of two touches meet, if that is as far from the one as from the other.
  static std::optional<Pair> circleOf(const Touch& a, const Touch& b) {
    constexpr double kParallel = 0.01;
    if (a.direction.z != 0 || b.direction.z != 0) return std::nullopt;
    const double cross = a.direction.x * b.direction.y - a.direction.y * b.direction.x;
    if (std::abs(cross) < kParallel) return std::nullopt;
    const Point3 between = b.point - a.point;
    const double way = (between.x * b.direction.y - between.y * b.direction.x) / cross;
    Pair out{a.point + a.direction * way, a.direction, std::abs(way), way < 0};
    if (out.half <= kSame || !liesOn(out, a) || !liesOn(out, b)) return std::nullopt;
    return out;
  }
  static bool liesOn(const Pair& circle, const Touch& touch) {
    if (touch.direction.z != 0) return false;
    const Point3 wall = circle.middle + touch.direction * (circle.outward ? circle.half : -circle.half);
    return std::hypot(wall.x - touch.point.x, wall.y - touch.point.y) <= kMiddle;
  }

  static std::vector<Pair> takePairs(std::vector<Touch>& rest) {
    std::vector<Pair> out;
    for (std::size_t i = 0; i < rest.size();) {
      const std::size_t other = partner(rest, i);
      if (other == rest.size()) {
        ++i;
        continue;
      }
      const Point3 between = rest[i].point - rest[other].point, direction = rest[i].direction;
      out.push_back({(rest[i].point + rest[other].point) * 0.5, direction, between.length() / 2,
                     between.dot(direction) > 0});
      rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(other));
      rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(i));
    }
    return out;
  }
  // Of touch i; rest.size(): it has none.
  static std::size_t partner(const std::vector<Touch>& rest, std::size_t i) {
    if (rest[i].direction.z != 0) return rest.size();
    for (std::size_t k = i + 1; k < rest.size(); ++k) {
      if (!isSame(rest[i].direction, rest[k].direction * -1)) continue;
      const Point3 between = rest[i].point - rest[k].point;
      const Point3 across = between - rest[i].direction * between.dot(rest[i].direction);
      if (across.length() <= kSame && between.length() > kSame) return k;
    }
    return rest.size();
  }

  // A bore or a boss of all pairs that have one middle and one size, at whatever heights.
  void takeRounds(std::vector<Pair>& pairs, std::vector<Touch>& rest) {
    for (std::size_t i = 0; i < pairs.size();) {
      const Pair first = pairs[i];
      const auto belongs = [&](const Pair& p) {
        return std::abs(p.middle.x - first.middle.x) <= kSame &&
               std::abs(p.middle.y - first.middle.y) <= kSame && std::abs(p.half - first.half) <= kSame &&
               p.outward == first.outward;
      };
      const auto crosses = [&](const Pair& p) {
        return belongs(p) && std::abs(p.direction.dot(first.direction)) < 0.5;
      };
      if (std::none_of(pairs.begin(), pairs.end(), crosses)) {
        ++i;
        continue;
      }
      double low = first.middle.z, high = low;
      for (const Pair& p : pairs) {
        if (!belongs(p)) continue;
        low = std::min(low, p.middle.z);
        high = std::max(high, p.middle.z);
      }
      addRound(first, low - kFaceHalf, first.outward ? high + kFaceHalf : takeTop(first, high, rest));
      std::erase_if(pairs, belongs);
    }
  }

  // Where a boss ends whose sides are touched as high as `high`: at the touch of its top, which is a surface
  // of its own no more.
  static double takeTop(const Pair& pair, double high, std::vector<Touch>& rest) {
    const auto top = std::find_if(rest.begin(), rest.end(), [&](const Touch& touch) {
      const Point3 beside = touch.point - pair.middle;
      return touch.direction.z < 0 && touch.point.z > high - kSame &&
             std::hypot(beside.x, beside.y) < pair.half;
    });
    if (top == rest.end()) return high + kFaceHalf;
    const double out = top->point.z;
    rest.erase(top);
    return out;
  }

  // Touched from `low` to `high`. What is measured at another height has a size of its own there.
  void addRound(const Pair& pair, double low, double high) {
    const Point3 middle = pair.middle - middle_;
    const Point3 bottom{middle.x, middle.y, low - middle_.z}, top{middle.x, middle.y, high - middle_.z};
    rounds_.push_back({{bottom, top, pair.half}, pair.outward});
  }
  void divideRounds() {
    for (Round& lower : rounds_)
      for (Round& upper : rounds_) {
        const Point3 &from = lower.bore.bottom, &to = upper.bore.bottom;
        const double lowerMiddle = (from.z + lower.bore.top.z) / 2,
                     upperMiddle = (to.z + upper.bore.top.z) / 2;
        if (lower.outward != upper.outward || lowerMiddle >= upperMiddle || lower.bore.top.z <= to.z ||
            std::hypot(from.x - to.x, from.y - to.y) > std::min(lower.bore.radius, upper.bore.radius))
          continue;
        const double between = (to.z + lower.bore.top.z) / 2;
        lower.bore.top.z = between;
        upper.bore.bottom.z = between;
      }
    for (const Round& one : rounds_) {
      if (one.outward)
        bores_.push_back(one.bore);
      else
        builder_.cylinder(one.bore.bottom, one.bore.top, one.bore.radius);
    }
  }

  // One plate for all: the plate of one closes no other.
  void addBores() {
    if (bores_.empty()) return;
    builder_.beginGroup(PartBuilder::Action::Add);
    for (const Bore& bore : bores_) {
      const double side = bore.radius + std::max(kRim, behind_);
      builder_.box(bore.bottom - Point3{side, side, 0}, bore.top + Point3{side, side, 0});
    }
    for (const Bore& bore : bores_)
      builder_.cylinder(bore.bottom, bore.top, bore.radius, PartBuilder::Action::Remove);
    builder_.endGroup();
  }

  void addPair(const Pair& pair) {
    const Point3 way = pair.direction * pair.half;
    if (!pair.outward) return addBlock(pair.middle - way, pair.direction, 2 * pair.half);
    addBlock(pair.middle + way, pair.direction, behind_);
    addBlock(pair.middle - way, pair.direction * -1, behind_);
  }

  // Its face looks against the touch.
  void addBlock(const Point3& point, const Point3& direction, double depth) {
    Block block;
    block.origin = point;
    block.axes[0] = direction;
    block.high[0] = depth;
    const bool level = direction.z == 0;
    block.axes[1] = level ? Point3{-direction.y, direction.x, 0} : Point3{1, 0, 0};
    block.axes[2] = level ? Point3{0, 0, 1} : Point3{0, 1, 0};
    block.low[1] = -beside_, block.high[1] = beside_;
    block.low[2] = level ? -kFaceHalf : -beside_, block.high[2] = level ? kFaceHalf : beside_;
    for (const Touch& touch : all_)
      if (touch.way > 0) makeWay(block, touch);
    Point3 middle = point - middle_;
    for (std::size_t i = 0; i < 3; ++i)
      middle = middle + block.axes[i] * ((block.low[i] + block.high[i]) / 2);
    const auto halfOf = [&](std::size_t i) { return (block.high[i] - block.low[i]) / 2; };
    if (!level)
      return builder_.block(middle, {0, 0, 1}, {1, 0, 0}, {halfOf(1), halfOf(2), halfOf(0)}, 0,
                            PartBuilder::Action::Add);
    builder_.block(middle, {0, 0, 1}, direction, {halfOf(0), halfOf(1), halfOf(2)}, 0,
                   PartBuilder::Action::Add);
  }

  // The first axis is the touch's; ends are counted from the touched point.
  struct Block {
    Point3 origin;
    std::array<Point3, 3> axes;
    std::array<double, 3> low{}, high{};
  };
  // The face ends half way to the ball of a touch that would meet it on its way. Where too little of it would
  // be left it stays: no part has both faces.
  void makeWay(Block& block, const Touch& touch) const {
    const bool level = touch.direction.z == 0;
    const Point3 end = level ? touch.point - touch.direction * radius_ : touch.point + Point3{0, 0, radius_};
    const Point3 begin = end - touch.direction * touch.way;
    std::array<double, 3> from{}, to{};
    double enters = 0, leaves = 1;
    for (std::size_t i = 0; i < 3; ++i) {
      from[i] = (begin - block.origin).dot(block.axes[i]);
      to[i] = (end - block.origin).dot(block.axes[i]);
      const double low = block.low[i] - radius_ + kMeets, high = block.high[i] + radius_ - kMeets;
      const double step = to[i] - from[i];
      if (std::abs(step) < kSame) {
        if (from[i] <= low || from[i] >= high) return;
        continue;
      }
      const double one = (low - from[i]) / step, other = (high - from[i]) / step;
      enters = std::max(enters, std::min(one, other));
      leaves = std::min(leaves, std::max(one, other));
    }
    if (enters >= leaves) return;
    std::size_t axis = 0;
    double gap = 2 * kLeast;
    for (const std::size_t i : {1U, 2U}) {
      const double off = std::min(std::abs(from[i]), std::abs(to[i])) - radius_;
      if (from[i] * to[i] <= 0 || off < gap) continue;
      axis = i;
      gap = off;
    }
    if (axis == 0) return;
    if (from[axis] > 0)
      block.high[axis] = std::min(block.high[axis], gap / 2);
    else
      block.low[axis] = std::max(block.low[axis], -gap / 2);
  }

  struct Bore {
    Point3 bottom, top;
    double radius = 0;
  };
  struct Round {
    Bore bore;
    bool outward = true;
  };
  std::vector<Round> rounds_;
  std::vector<Bore> bores_;
  Point3 middle_; // zero of the part: what it is turned about
  const std::vector<Touch>& all_;
  double radius_, beside_, behind_;
  PartBuilder builder_;
  bool tooMany_ = false;
};

} // namespace

std::optional<Part> partOf(const std::vector<Touch>& touches, double ballRadius, double reach,
                           const PartError& error) {
  if (touches.empty()) return std::nullopt;
  const std::optional<Part> nominal = Shapes(touches, ballRadius, reach).finish();
  if (!nominal) return std::nullopt;
  return withError(*nominal, touches, error);
}

Part withError(const Part& nominal, const std::vector<Touch>& touches, const PartError& error) {
  return nominal.placed({middleOf(touches), {}}, {error.shift, {0, 0, error.turn}});
}

double mostOff(const std::vector<Touch>& touches, const PartError& error) {
  const Point3 middle = middleOf(touches);
  double arm = 0;
  for (const Touch& touch : touches)
    arm = std::max(arm, std::hypot(touch.point.x - middle.x, touch.point.y - middle.y));
  // On a face that is turned the ball touches a little beside its middle.
  const double beside = error.turn != 0 ? 0.001 : 0;
  return error.shift.length() + arm * std::abs(error.turn) * std::numbers::pi / 180 + beside;
}

} // namespace dotek::verify
