// Arcs, roughing and drilling cycles, threads: what follows from where the tool stands in the order of the
// text.
#pragma once

#include "frontend/mikroprog/Ast.h"
#include "stdlib/MikroprogControl.h"
#include "support/Diagnostics.h"

namespace dotek::frontend::mikroprog {

// Where a place is not certain (behind a jump, a contact, a change of the system) nothing is said.
void checkGeometry(const Program& program, const stdlib::MikroprogControl& control, const SourceMap& sources,
                   Diagnostics& diagnostics);

} // namespace dotek::frontend::mikroprog
