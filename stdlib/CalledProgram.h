// Which program a subprogram call without L means.
#pragma once

#include "stdlib/Control.h"

#include <cstdint>

namespace dotek::stdlib {

struct SubprogramCall {
  std::uint64_t program; // O number
  std::uint32_t times;
};

// M98 P`written`, from 1 to 99999999: where the control repeats in P, digits before the last four say how
// often.
constexpr SubprogramCall subprogramCall(std::uint64_t written, const Control& control) {
  constexpr std::uint64_t kPrograms = 10'000;
  if (!control.repeatInProgram || written < kPrograms) return {written, 1};
  return {written % kPrograms, static_cast<std::uint32_t>(written / kPrograms)};
}

} // namespace dotek::stdlib
