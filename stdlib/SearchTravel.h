// How far a macro searches, by its signature.
#pragma once

#include "stdlib/MacroSet.h"

namespace dotek::stdlib {

// Of a surface: it takes a travel and no overtravel, so the travel is its whole search.
bool travelIsSearch(const MacroSignature& signature, const MacroArgument& argument);
// The same of its target along the axis; false: it has none.
bool travelIsSearch(const MacroSignature& signature, ir::Axis axis);

} // namespace dotek::stdlib
