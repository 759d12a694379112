// G and M words as codes. Private to the scanner.
#pragma once

#include "ir/NcWords.h"

#include <cstdint>

namespace dotek::frontend::nc {

inline constexpr unsigned kG = 'G' - 'A', kO = 'O' - 'A';
inline constexpr std::uint32_t kCodeBits = ir::addressBits("GM");

inline std::uint32_t gCode(std::uint64_t digits, std::uint64_t places, bool minus) {
  if (minus || places > 1 || digits > 99999) return ir::NcWords::kNoCode;
  return static_cast<std::uint32_t>(digits) * (places == 0 ? 10 : 1);
}
inline std::uint32_t mCode(std::uint64_t digits, bool point, bool minus) {
  if (minus || point || digits > 99'999'999) return ir::NcWords::kNoCode;
  return static_cast<std::uint32_t>(digits);
}

} // namespace dotek::frontend::nc
