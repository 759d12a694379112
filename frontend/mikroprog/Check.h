// Findings inside one program of Mikroprog.
#pragma once

#include "frontend/mikroprog/Ast.h"
#include "stdlib/MikroprogControl.h"
#include "support/Diagnostics.h"

namespace dotek::frontend::mikroprog {

// Checks a parsed program against what the control is known to take. What the reader reported is not
// repeated.
void checkProgram(const Program& program, const stdlib::MikroprogControl& control, const SourceMap& sources,
                  Diagnostics& diagnostics);

} // namespace dotek::frontend::mikroprog
