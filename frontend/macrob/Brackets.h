// A bracket that is lost, or that is one too many: where every way to put a value right means the same, there
// is one repair. Included by builder sources only.
#pragma once

#include "frontend/macrob/Tokens.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace dotek::frontend::macrob {

struct BracketRepair {
  std::size_t at = 0;  // token of the span
  bool closes = false; // a `]` is put in after it; else it is taken out
};

// Of the tokens from `first` up to `end`, a value: of a word, which is one bracket or one operand, or of an
// assignment. nullopt: its brackets match, more than one is wrong, or it could mean different things.
std::optional<BracketRepair> bracketRepair(const std::vector<Tok>& tokens, std::size_t first, std::size_t end,
                                           bool ofWord);

} // namespace dotek::frontend::macrob
