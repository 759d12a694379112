// Axes as letters, bits and numbers. Private to the machine.
#pragma once

#include "ir/NcWords.h"
#include "sim/machine/Trace.h"

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace dotek::sim {

inline constexpr double kInch = 25.4; // mm
inline constexpr std::uint32_t kAxisBits = ir::addressBits("XYZABCUVW");
inline constexpr std::uint32_t kRotaryBits = ir::addressBits("ABC");

// Index into NcWords::value.
constexpr unsigned slotOf(char letter) {
  return static_cast<unsigned>(letter - 'A');
}
inline bool has(const ir::NcWords& words, std::size_t axis) {
  return (words.present >> slotOf(kAxisLetters[axis]) & 1) != 0;
}
// Bits by axis number of the axes among `letters`.
constexpr std::uint32_t axisNumbers(std::uint32_t letters) {
  std::uint32_t out = 0;
  for (unsigned i = 0; i < kAxes; ++i)
    out |= (letters >> slotOf(kAxisLetters[i]) & 1) << i;
  return out;
}

// Axes of a plane: 0 XY, 1 ZX, 2 YZ; the third is the drilling axis. Beside each the address of an arc's
// centre.
struct PlaneAxes {
  std::size_t first, second, third;
  char firstCentre, secondCentre, unusedCentre;
  std::string_view name;
};
inline constexpr PlaneAxes kPlanes[3] = {
    {0, 1, 2, 'I', 'J', 'K', "xy"}, {2, 0, 1, 'K', 'I', 'J', "zx"}, {1, 2, 0, 'J', 'K', 'I', "yz"}};

// Sums of lengths lie on a grid of a nanometre, so that 0.1 + 0.2 is 0.3 as on a control that counts
// increments.
inline double snap(double value) {
  constexpr double kRound = 6755399441055744.0; // 1.5 * 2^52: adding it rounds to a whole number
  const double scaled = value * 1e6;
  if (!(scaled < 2e15 && scaled > -2e15)) return value;
  return ((scaled + kRound) - kRound) / 1e6;
}

} // namespace dotek::sim
