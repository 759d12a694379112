// Cycles of the library that programs of a macro set carry out.
#pragma once

#include "frontend/cycle/Lower.h"
#include "project/CycleFiles.h"
#include "stdlib/MacroSet.h"

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace dotek::project {

// By their trees. A program carries out the cycle of its name (stdlib::libraryCycle()) where it has a letter
// for each of the cycle's parameters, demands no further one, and leaves each of its results in a variable
// that a source describes.
std::map<const frontend::cycle::File*, frontend::cycle::MacroCycle> macroCycles(const stdlib::MacroSet& set,
                                                                                CycleFiles& files);

// What programs of the sets measure, as cycles by their names (stdlib::libraryCycle(), islandCycle()). One of
// a folder of --data that has a mistake is reported and missing. A set that is nullptr has none.
std::map<std::string, ir::Cycle, std::less<>>
measuringCycles(const std::vector<const stdlib::MacroSet*>& sets, Session& session);

} // namespace dotek::project
