// From the IR of programs to what runs.
#pragma once

#include "sim/machine/Bytecode.h"
#include "sim/machine/Cells.h"
#include "stdlib/Control.h"
#include "support/Source.h"

#include <cstddef>
#include <vector>

namespace dotek::sim {

// The first program is the main one, all can be called. They and `control` outlive the result. Nothing is
// refused here: a statement that cannot run ends the run where it is reached. So do blocks that mean
// something else on a lathe, where the programs after the first `made` ones, which are Dotek's own, are for
// one.
Bytecode compile(const std::vector<const ir::Program*>& programs, const stdlib::Control& control,
                 const SourceMap& sources, std::size_t made = 0);

// The N number that a value names: rounded, within what the control can search. 0: none.
std::uint64_t sequenceNumber(double value, const stdlib::Control& control);

} // namespace dotek::sim
