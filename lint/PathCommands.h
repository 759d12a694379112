// What ToolPath.mac adds to the path of a cycle, as it is written.
#pragma once

#include "lint/MacroNames.h"

#include <array>
#include <set>
#include <string>
#include <vector>

namespace dotek::lint {

// One ADD_CUSTOM_DRILL_CYCLE_PATH. `axes`: the values of X, Y and Z that it gives; nullptr: none.
struct PathCommand {
  const gibbs::Statement* statement = nullptr; // the command itself
  const gibbs::If* condition = nullptr;        // IF .. THEN of one line in front of it
  std::array<const gibbs::Expression*, 3> axes = {};
};
std::vector<PathCommand> pathCommands(const gibbs::Macro& toolPath);

// A summand of an expression, `-radius` as name RADIUS with a negative sign; products and calls have no name.
struct Term {
  std::string name; // folded; "" of anything but a plain variable
  bool negative = false;
};
std::vector<Term> termsOf(const gibbs::Expression& expression);
// +1 or -1 where the name is a term of its own, 0 where it is none.
int signOf(const gibbs::Expression& expression, const std::string& name);

// Folded names of the variables that a GET_CUSTOM_DRILL_CYCLE_DATA fills with the parameter.
std::set<std::string> drillData(const gibbs::Macro& macro, const std::string& parameter);

} // namespace dotek::lint
