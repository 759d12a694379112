// What a control takes beyond Macro B as the others read it, where that decides how a block is read.
#pragma once

namespace dotek::stdlib {
struct Control;
}

namespace dotek::frontend::macrob {

struct Forms {
  bool shortWords = false;     // WH[..]DO1, EN1, SQ[..]
  bool thenOptional = false;   // IF[..] #1=2, IF[..] G65 P1
  bool parameterBits = false;  // #30057.21, and IF[..] of a value, which is true where that is not 0
  bool nestedComments = false; // (A (B))
  bool smallLetters = false;   // x5.
};

Forms formsOf(const stdlib::Control& control);

} // namespace dotek::frontend::macrob
