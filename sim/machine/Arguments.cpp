#include "sim/machine/Arguments.h"

#include "sim/machine/Value.h"
#include "stdlib/MacroSet.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dotek::sim {

const stdlib::CallCode* findCallCode(const stdlib::Control& control, char letter, double value) {
  for (const stdlib::CallCode& call : control.callCodes) {
    if (call.letter != letter || call.program == 0) continue; // 0: a block of the same program
    if (letter == 'T') return &call;
    const double whole = letter == 'M' ? std::round(value) : value;
    if (whole >= call.first && whole < call.first + call.count && whole == std::floor(whole)) return &call;
  }
  return nullptr;
}

GivenLetters givenLetters(std::span<const double> locals) {
  GivenLetters out;
  for (std::uint32_t local = 1; local < locals.size(); ++local) {
    if (isNull(locals[local])) continue;
    const char letter = stdlib::letterOfLocal(local);
    if (letter != 0)
      out.letters += letter;
    else if (out.unlettered == 0)
      out.unlettered = local;
  }
  return out;
}

std::uint32_t ArgumentLetters::next(char letter) {
  //                                      A  B  C  D  E  F  G  H  I  J  K  L  M   N  O  P
  static constexpr std::uint8_t kLocals[] = {
      1, 2, 3, 7, 8, 9, 0, 11, 4, 5, 6, 0, 13, 0, 0, 0,
      //                                      Q   R   S   T   U   V   W   X   Y   Z
      17, 18, 19, 20, 21, 22, 23, 24, 25, 26};
  if (letter < 'A' || letter > 'Z') return 0;
  if (letter < 'I' || letter > 'K') return kLocals[letter - 'A'];
  const int at = letter - 'I';
  if (at <= last_) ++set_;
  last_ = at;
  return set_ < 10 ? static_cast<std::uint32_t>(4 + 3 * set_ + at) : 0;
}

} // namespace dotek::sim
