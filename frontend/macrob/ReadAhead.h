// Positions that are read while the axes move, for the simulator too.
#pragma once

#include "stdlib/Control.h"
#include "support/Check.h"

#include <cstdint>

namespace dotek::frontend::macrob {

// One finding of position-read-early.
Diagnostic& reportReadAhead(SourceRange read, std::uint32_t variable, const stdlib::Control& control,
                            Report& report);

} // namespace dotek::frontend::macrob
