// The part of verify() that looks at one statement alone.
#pragma once

#include "ir/Cycle.h"

#include <string>
#include <string_view>
#include <vector>

namespace dotek::ir {

struct ShapeFault {
  SourceRange range; // no place: the statement's
  std::string message;
  bool breaks = false; // an expression is missing, or an id does not exist: the rest cannot be looked at
};
std::vector<ShapeFault> shapeFaults(const CycleStatement& statement, const Cycle& cycle);

// What a statement does that checks do not: "a move"; "" for one that may appear there.
std::string_view notInChecks(const CycleStatement& statement);

bool isFinite(double value);

} // namespace dotek::ir
