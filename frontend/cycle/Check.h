// What a cycle says that is wrong whatever its values are: names, kinds and units, the order of things.
#pragma once

#include "frontend/cycle/Ast.h"
#include "support/Diagnostics.h"

namespace dotek::frontend::cycle {

// Reports to `diagnostics`. Broken parts of the tree are passed over: they were reported. Cycles that it
// calls and options that it uses are those that link() found.
void check(const File& file, const SourceMap& sources, Diagnostics& diagnostics);

} // namespace dotek::frontend::cycle
