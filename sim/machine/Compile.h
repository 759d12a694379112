// From the IR of programs to what runs.
#pragma once

#include "sim/machine/Bytecode.h"
#include "sim/machine/Cells.h"
#include "stdlib/Control.h"
#include "support/Source.h"

#include <vector>

namespace dotek::sim {

// The first program is the main one, all can be called. They and `control` outlive the result. Nothing is
// refused here: a statement that cannot run ends the run where it is reached.
Bytecode compile(const std::vector<const ir::Program*>& programs, const stdlib::Control& control,
                 const SourceMap& sources);

// The N number that a value names: rounded, within what the control can search. 0: none.
std::uint64_t sequenceNumber(double value, const stdlib::Control& control);

} // namespace dotek::sim
