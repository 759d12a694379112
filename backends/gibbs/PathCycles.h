// Cycles of macro sets as the moves that a path shows of them: what the call touches, where it expects it.
#pragma once

#include "ir/Cycle.h"

#include <functional>
#include <map>
#include <optional>
#include <vector>

namespace dotek::backends::gibbs {

struct DrawnCycle {
  std::vector<ir::CycleStatement> steps; // moves and touches of single surfaces, back to where it began
  // What the call finds where everything is as expected.
  std::map<ir::ResultName, ir::ExpressionPtr> values;
  std::map<ir::ResultName, ir::Coordinate> places; // positions, counted from where the probe is at the end
};

// What is known at the call.
struct PathState {
  std::function<ir::ExpressionPtr()> ball; // its radius, where that is needed
  ir::ExpressionPtr height;                // along Z, from the start of the path
  std::optional<double> clearance;         // beside a surface of calls that state none
};

// nullopt: no document states the touches of the cycle, or it does not state enough.
std::optional<DrawnCycle> drawnCycle(const ir::CallCycle& cycle, const PathState& now,
                                     const ir::Origin& origin);

} // namespace dotek::backends::gibbs
