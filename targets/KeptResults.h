// Results of a cycle of the cycle language that its program leaves in variables of the control (--result).
#pragma once

#include "ir/Cycle.h"
#include "support/Diagnostics.h"
#include "targets/Options.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
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
// `handed`: where else a result goes whose name is not given, without a heading of --result.
KeptResults
keepResults(ir::Cycle& cycle, const NamedTexts& given, Diagnostics& diagnostics,
            const std::function<std::optional<std::uint32_t>(const std::string& name)>& handed = nullptr);
// "#520" or "520"; nothing: it is no number of a variable.
std::optional<std::uint32_t> resultNumber(std::string_view text);

} // namespace dotek::targets
