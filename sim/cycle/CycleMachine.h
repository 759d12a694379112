// The machine that cycles run on by their meaning: that of no control.
#pragma once

#include "stdlib/Control.h"

namespace dotek::sim {

// Common variables #100 to #999, 999 tools, G54.1 P1 to P300. No code has a meaning: nothing executes blocks.
const stdlib::Control& cycleControl();

} // namespace dotek::sim
