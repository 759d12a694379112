// Which work system a number names that a call is given, tried on the checks of a cycle.
#pragma once

#include "ir/Cycle.h"
#include "ir/Evaluate.h"

#include <optional>
#include <set>
#include <vector>

namespace dotek::backends {

// Numbers that name systems beyond the first six; first 0: none do.
struct ExtendedSystems {
  double first = 0, last = 0, step = 1;
};

// 54 to 59, or one of `extended`.
bool namesSystem(double number, const ExtendedSystems& extended);

// With what the checks assign once, by the values of the environment.
ir::Environment withLocals(const ir::Cycle& cycle, ir::Environment environment);

// Other values of the arguments: the defaults, and some that differ.
std::vector<ir::Environment> environmentsOf(const ir::Cycle& cycle);

// The variables that a caller gives, from which the checks compute `value`.
std::set<ir::VariableId> givenFor(const ir::Cycle& cycle, const ir::ExpressionPtr& value);

struct NoSystem {
  double given = 0; // the variable's value
  double number = 0;
};

// The first value of `id` that the checks let pass, where they let only such pass as `system` makes no work
// system of: then whoever calls the program gets an alarm. Values that end like the largest or the smallest
// are those that the checks of `id` reject, whatever the other arguments are.
std::optional<NoSystem> passesNoSystem(const ir::Cycle& cycle, ir::VariableId id,
                                       const ir::ExpressionPtr& system, const ExtendedSystems& extended);

} // namespace dotek::backends
