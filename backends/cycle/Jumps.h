// Jumps of the source as the language has them.
#pragma once

#include "backends/cycle/State.h"

#include <optional>
#include <set>
#include <string>
#include <vector>

namespace dotek::backends::cycle {

// Branches in a row as one decision, and alarms in the place of the jumps that lead to them.
void straightenJumps(State& state);

// Labels that a later statement leads back to.
std::set<ir::LabelId> loopLabels(const std::vector<ir::CycleStatement>& list);

// `N1 IF A GOTO 2 .. GOTO 1 N2`, by the places of its statements.
struct Loop {
  std::size_t label = 0, branch = 0, back = 0, after = 0;
  std::string most;                     // runs at most, where a counter says so; "": unknown
  std::optional<ir::VariableId> mostOf; // the parameter that says so instead
  double mostPlus = 0;                  // and how many more it is
  bool onlyCounts = false;              // the counter is read nowhere else
  std::set<std::size_t> dropped;        // the statements of such a counter
};
// nullopt: the label begins no loop of that form.
std::optional<Loop> loopAt(const State& state, std::size_t label);

} // namespace dotek::backends::cycle
