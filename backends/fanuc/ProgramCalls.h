// Calls of probing macros in programs: from the pack of one vendor to that of another.
#pragma once

#include "ir/Program.h"
#include "stdlib/MacroSet.h"
#include "support/Diagnostics.h"

#include <vector>

namespace dotek::backends::fanuc {

// The set whose programs the file calls: the one that knows every called number that some set knows. nullptr:
// none is called, or they belong to no single set (`mixed` is a call that does not fit).
const stdlib::MacroSet* calledSet(const ir::ProgramFile& file, const std::vector<stdlib::MacroSet>& sets,
                                  const ir::Statement** mixed = nullptr);

// Calls of the program become those of `wanted`. Today a program that calls another set is refused; one that
// calls `wanted`, or no probing macro, stays. False where it was refused: reported.
bool translateCalls(ir::Program& program, const stdlib::MacroSet& wanted,
                    const std::vector<stdlib::MacroSet>& sets, Diagnostics& diagnostics);

} // namespace dotek::backends::fanuc
