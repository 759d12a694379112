// Which program a subprogram call without L means, and which codes call a block of their own program.
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

// The address that names the block where `code`, called with no program, runs a part of the same program up
// to M99: Q of M98, P of M97. 0: the control has no such call. Kept among the call codes, with no program.
inline char localCallAddress(const Control& control, char letter, std::uint32_t code) {
  for (const CallCode& call : control.callCodes)
    if (call.program == 0 && call.letter == letter && call.first == code && call.holds)
      return static_cast<char>(*call.holds);
  return 0;
}

} // namespace dotek::stdlib
