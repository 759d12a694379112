// Which variables may be null where.
#pragma once

#include "ir/Cycle.h"
#include "ir/NumberSet.h"

#include <vector>

namespace dotek::ir {

// Variables that may be null before each statement; the caller of the cycle leaves out optional parameters
// without a default. A branch on IsNull tells its two ways apart.
struct Nulls {
  std::vector<NumberSet> checks, body;
};
Nulls findNulls(const Cycle& cycle);

// Whether the value may be null where these variables may.
bool mayBeNull(const ExpressionPtr& expression, const NumberSet& variables);

// The variable of `x is null`, or of `x is not null` with `negated`; nullptr for another condition.
const VariableUse* nullTest(const ConditionPtr& condition, bool& negated);

} // namespace dotek::ir
