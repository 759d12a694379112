// Where a post takes `unit` for a number. Which numbers MM and IN are is documented nowhere.
#pragma once

#include "frontend/fusion/Scopes.h"

namespace dotek::frontend::fusion {

// Comparisons with a number, a switch with numbers, `unit ? ..`, `list[unit]` and sums, in the order of
// reading.
std::vector<const Node*> unitsAsNumbers(const Tree& tree, const Scopes& scopes);

} // namespace dotek::frontend::fusion
