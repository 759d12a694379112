// Straight paths between positions, along the linear axes. Private to what moves the probe.
#pragma once

#include "sim/machine/Machine.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace dotek::sim {

// Shorter paths are none, mm: lengths lie on a grid of a nanometre.
inline constexpr double kNoPath = 1e-6;

// The position that lies so many mm from `from` along a direction of length 1.
inline Position along(const Position& from, const std::array<double, 3>& direction, double distance) {
  Position out = from;
  for (std::size_t i = 0; i < direction.size(); ++i)
    out[i] += direction[i] * distance;
  return out;
}

// In mm; the other axes do not count.
inline double distance(const Position& a, const Position& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

} // namespace dotek::sim
