// Cycles of the library that programs of a macro set carry out.
#pragma once

#include "frontend/cycle/Lower.h"
#include "project/CycleFiles.h"
#include "stdlib/MacroSet.h"

#include <map>

namespace dotek::project {

// By their trees. A program carries out the cycle of its name (stdlib::libraryCycle()) where it has a letter
// for each of the cycle's parameters, demands no further one, and leaves each of its results in a variable
// that a source describes.
std::map<const frontend::cycle::File*, frontend::cycle::MacroCycle> macroCycles(const stdlib::MacroSet& set,
                                                                                CycleFiles& files);

} // namespace dotek::project
