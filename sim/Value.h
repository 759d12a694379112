// The value of a macro variable: a double, or null as one pattern of NaN. Arithmetic on it would keep the
// pattern, so whoever computes reads it as 0 first.
#pragma once

#include <bit>
#include <cstdint>

namespace dotek::sim {

inline constexpr std::uint64_t kNullBits = 0x7FF8'0000'6E75'6C6CULL;
inline constexpr double kNull = std::bit_cast<double>(kNullBits);

inline bool isNull(double value) {
  return std::bit_cast<std::uint64_t>(value) == kNullBits;
}

} // namespace dotek::sim
