// Private to Target*.cpp: a cycle of the cycle language as these controls take it. They compute nothing while
// a program runs, so what it reads has to be known, and what it measures is recorded.
#pragma once

#include "ir/Cycle.h"
#include "project/Lowering.h"
#include "support/Diagnostics.h"

namespace dotek::targets {

// Before it is folded: parameters that nobody has given are null, results and reports are left to the records
// of the contacts (a note), and protected moves have the speed of the control.
void prepareCycle(project::LoweredCycle& lowered, Diagnostics& diagnostics);

// After it is folded to a list without jumps: `set` becomes part of the touch whose surface it is given.
// Reports what takes its value from anything else.
void joinSettings(ir::Cycle& cycle, Diagnostics& diagnostics);

} // namespace dotek::targets
