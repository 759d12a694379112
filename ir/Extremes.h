// Searches for the greatest or the least of several values.
#pragma once

#include "ir/Program.h"

#include <cstddef>
#include <vector>

namespace dotek::ir {

// The Branch at `at` keeps the larger or the smaller of two values and decides nothing else: IF[a GT b]THEN
// b=a, or the same by jumps. What else is stored with it, the number of the value as a rule, is no constant:
// that could be a flag, which is looked at later.
bool keepsExtreme(const std::vector<ProgramStatement>& body, std::size_t at);

} // namespace dotek::ir
