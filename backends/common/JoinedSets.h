// A cycle that touches a surface and then sets an offset by it, for macros that measure only to set one.
#pragma once

#include "ir/Cycle.h"
#include "stdlib/MacroSet.h"

namespace dotek::backends {

// The cycle, in which a touch of a surface sets the work offset that `set` after it sets by what it has
// found, where the macros of the set touch no surface along that axis without setting one. Nothing but the
// probe's switch lies between the two, and nothing else reads what the touch gives.
ir::Cycle joinSets(const ir::Cycle& given, const stdlib::MacroSet& macros);

} // namespace dotek::backends
