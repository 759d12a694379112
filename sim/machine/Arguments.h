// Codes and letters of blocks that call programs, as a control's table says.
#pragma once

#include "stdlib/Control.h"

#include <cstdint>
#include <span>
#include <string>

namespace dotek::sim {

// The call that the code is; nullptr: it is an ordinary one.
const stdlib::CallCode* findCallCode(const stdlib::Control& control, char letter, double value);

// The letters of the arguments that a call gives, in the order of the locals they set.
struct GivenLetters {
  std::string letters;
  std::uint32_t unlettered = 0; // the first local that is given and that no letter sets; 0: none is
};
// `locals` by number, from #0 (unused) on; kNull where there is no argument.
GivenLetters givenLetters(std::span<const double> locals);

// The locals of the words of a call: of I, J, K each set has its own (argument specification II).
class ArgumentLetters {
public:
  // #n that the next word with this letter sets; 0: it is no argument.
  std::uint32_t next(char letter);

private:
  int set_ = 0, last_ = -1; // of I, J, K: 0, 1, 2
};

} // namespace dotek::sim
