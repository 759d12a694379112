// Results of a cycle of the cycle language that its program leaves in variables of the control (--result).
#pragma once

#include "ir/Cycle.h"
#include "support/Diagnostics.h"
#include "targets/Options.h"

#include <cstdint>
#include <set>
#include <string>
#include <vector>

namespace dotek::targets {

struct KeptResults {
  std::set<std::uint32_t> numbers;   // of the variables
  std::set<std::uint32_t> stored;    // those of them that hold a value for later runs
  std::vector<std::string> headings; // "RESULT SIZE IN #520", in the order of the results
  std::vector<std::string> lost;     // results that nobody gets, by name
};

// Ends the cycle with a store for each result that `given` names (NAME and #NUMBER) in the place of what it
// leaves its caller; the others are left out. So does each value for later runs (`set stored NAME`) become a
// store; those that are not named stay as they are. Names that it does not have and numbers that are none are
// reported. Whether the control has the variable says who writes the program.
KeptResults keepResults(ir::Cycle& cycle, const NamedTexts& given, Diagnostics& diagnostics);

} // namespace dotek::targets
