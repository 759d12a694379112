// Control flow of a statement list.
#pragma once

#include "ir/Cycle.h"
#include "ir/Program.h"

#include <cstddef>
#include <vector>

namespace dotek::ir {

// Indices of the statements that may follow each statement of a cycle or a program (a computed jump: all
// labels); `list.size()` is the end. Return and Exit go to the end, Alarm and Raise to none. Codes mean
// nothing here: a block with M30 goes on at the next one.
std::vector<std::vector<std::size_t>> successors(const std::vector<CycleStatement>& list);
std::vector<std::vector<std::size_t>> successors(const std::vector<ProgramStatement>& list);
std::vector<bool> reachable(const std::vector<CycleStatement>& list);
std::vector<bool> reachable(const std::vector<ProgramStatement>& list);

} // namespace dotek::ir
