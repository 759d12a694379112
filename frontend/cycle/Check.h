// What a cycle says that is wrong whatever its values are: names, kinds and units, the order of things.
#pragma once

#include "frontend/cycle/Ast.h"
#include "support/Diagnostics.h"

#include <functional>
#include <string>

namespace dotek::frontend::cycle {

// The sound tree of a cycle by its name; nullptr: there is none.
using FindCycle = std::function<const File*(const std::string& name)>;

// Reports to `diagnostics`. Broken parts of the tree are passed over: they were reported.
void check(const File& file, const SourceMap& sources, const FindCycle& find, Diagnostics& diagnostics);

} // namespace dotek::frontend::cycle
