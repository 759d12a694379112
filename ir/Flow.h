// Control flow of a statement list.
#pragma once

#include "ir/Cycle.h"

#include <cstddef>
#include <vector>

namespace dotek::ir {

// Indices of the statements that may follow each statement of a cycle or a program (a computed jump: all
// labels); `list.size()` is the end. Alarm and Return go to
// none but Return goes to the end.
std::vector<std::vector<std::size_t>> successors(const std::vector<Statement>& list);
std::vector<bool> reachable(const std::vector<Statement>& list);

} // namespace dotek::ir
