// Macros whose variables may lie elsewhere (`--probe-macros dotek@900`): where a branch keeps values in them.
#pragma once

#include "ir/Cycle.h"
#include "ir/Program.h"
#include "stdlib/Control.h"
#include "stdlib/MacroSet.h"
#include "support/Diagnostics.h"

#include <cstdint>
#include <set>
#include <string>

namespace dotek::backends {

// Numbers of variables of the machine in the cycle; of computed ones what they count from.
std::set<std::uint32_t> numbersOf(const ir::Cycle& cycle);
std::set<std::uint32_t> numbersOf(const ir::ProgramFile& file);

// What to write in place of a value that is stored where the macros keep theirs.
std::string storeRemedy(const stdlib::MacroSet& macros, const stdlib::Control& control,
                        const std::set<std::uint32_t>& used);

// false: the variables that the macros keep are none of the control, or lost at power off; reported.
bool holdsKept(const stdlib::MacroSet& macros, const stdlib::Control& control, Diagnostics& diagnostics);

} // namespace dotek::backends
