// Findings on labels, GOTO, FOR and NEXT of one macro.
#pragma once

#include "frontend/gibbs/Parse.h"

#include <vector>

namespace dotek::frontend::gibbs {

// Unverified jumps into a FOR are added to `intoFor`.
void checkFlow(const Macro& macro, const std::vector<const Macro*>& included, const ParseContext& context,
               std::vector<SourceRange>& intoFor);

} // namespace dotek::frontend::gibbs
