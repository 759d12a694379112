// The value of a macro variable: a double, or null as one pattern of NaN. Arithmetic on it would keep the
// pattern, so whoever computes reads it as 0 first.
#pragma once

#include <bit>
#include <cstdint>

namespace dotek::sim {

inline constexpr std::uint64_t kNullBits = 0x7FF8'0000'6E75'6C6CULL;
inline constexpr double kNull = std::bit_cast<double>(kNullBits);
// Null of a variable that nobody has written: what a run wrote can be reported from what it left alone.
inline constexpr std::uint64_t kFreshBits = kNullBits | 1;
inline constexpr double kFresh = std::bit_cast<double>(kFreshBits);

inline bool isNull(double value) {
  return (std::bit_cast<std::uint64_t>(value) | 1) == kFreshBits;
}
inline bool isFresh(double value) {
  return std::bit_cast<std::uint64_t>(value) == kFreshBits;
}
inline double nullAsZero(double value) {
  return isNull(value) ? 0 : value;
}

// What a macro of a vendor left in a variable and no source tells: reading it ends the run.
inline constexpr std::uint64_t kUnknownBits = 0x7FF8'0000'756E'6B6EULL;
inline constexpr double kUnknown = std::bit_cast<double>(kUnknownBits);

inline bool isUnknown(double value) {
  return std::bit_cast<std::uint64_t>(value) == kUnknownBits;
}

} // namespace dotek::sim
