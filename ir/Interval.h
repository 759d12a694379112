// Between what a value lies, whatever its variables are.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace dotek::ir {

// Both ends belong to it. Without ends: any number.
struct Interval {
  static constexpr double kNone = std::numeric_limits<double>::infinity();
  double low = -kNone, high = kNone;

  bool any() const { return low == -kNone && high == kNone; }
};

inline Interval negated(Interval a) {
  return {-a.high, -a.low};
}
inline Interval sum(Interval a, Interval b) {
  return {a.low + b.low, a.high + b.high};
}
inline Interval product(Interval a, Interval b) {
  Interval out{Interval::kNone, -Interval::kNone};
  for (const double x : {a.low, a.high})
    for (const double y : {b.low, b.high}) {
      const double one = x == 0 || y == 0 ? 0 : x * y; // 0 of all numbers is 0, an end of none aside
      out.low = std::min(out.low, one);
      out.high = std::max(out.high, one);
    }
  return out;
}
inline Interval absolute(Interval a) {
  if (a.low >= 0) return a;
  if (a.high <= 0) return negated(a);
  return {0, std::max(-a.low, a.high)};
}

// Whether left < right holds for all values; nothing: it depends on them.
inline std::optional<bool> alwaysLess(Interval left, Interval right) {
  if (left.high < right.low) return true;
  if (left.low >= right.high) return false;
  return std::nullopt;
}
// Whether left <= right does.
inline std::optional<bool> alwaysAtMost(Interval left, Interval right) {
  const auto turned = alwaysLess(right, left);
  return turned ? std::optional(!*turned) : std::nullopt;
}
// Whether left = right does.
inline std::optional<bool> alwaysEqual(Interval left, Interval right) {
  if (left.high < right.low || right.high < left.low) return false;
  return std::nullopt;
}

} // namespace dotek::ir
