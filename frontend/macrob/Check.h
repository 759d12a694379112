// Findings inside one file of programs that need no other file.
#pragma once

#include "frontend/macrob/Ast.h"
#include "stdlib/Control.h"
#include "support/Diagnostics.h"
#include "support/Source.h"

namespace dotek::frontend::macrob {

// Checks each program of a parsed file. What the parser reported is not repeated. `control`: the machine that
// the programs are for; nullptr: only what holds on every control.
void checkFile(const File& file, const stdlib::Control* control, const SourceMap& sources,
               Diagnostics& diagnostics);

} // namespace dotek::frontend::macrob
