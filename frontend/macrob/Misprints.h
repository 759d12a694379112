// Misprints of a typist: O for 0, a decimal comma, brackets. What the tokens of one block show, and the
// repair where there is one only. Included by builder sources only.
#pragma once

#include "frontend/macrob/Forms.h"
#include "frontend/macrob/Tokens.h"
#include "support/Diagnostics.h"

#include <string>
#include <vector>

namespace dotek::frontend::macrob {

// Of one block, in the order of its text.
struct Misprints {
  std::vector<Diagnostic> found; // each with what to write
  // What the control takes as it is written and a reader may not: told only where the block can be read.
  std::vector<Diagnostic> remarks;
};

// Repairs `tokens` (without the end of the block).
Misprints repairMisprints(std::vector<Tok>& tokens, FileId file, std::string_view source, Forms forms);

// The one error of a block that the grammar does not take; `at` is the token that does not fit, tokens.size()
// for the end of the block.
Diagnostic explainBlock(const std::vector<Tok>& tokens, std::size_t at, FileId file, std::string_view source,
                        std::uint32_t end);

} // namespace dotek::frontend::macrob
