// Kinds of variables from their use.
#pragma once

#include "ir/Cycle.h"

namespace dotek::ir {

// Gives a kind to each variable of kind Number that a statement uses where a kind is required (coordinates,
// feeds, diameters, systems), through assignments, sums and comparisons. A variable that is used as two kinds
// keeps the first; verify() then reports the mixing.
void inferKinds(Cycle& cycle);

} // namespace dotek::ir
