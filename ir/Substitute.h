// Values put in for variables: what simplify() and fold() share.
#pragma once

#include "ir/Evaluate.h"

namespace dotek::ir {

// The expression with the variables that `environment` knows replaced, simplified. Null is put in where it
// may appear only. The same pointer where nothing changes.
ExpressionPtr substitute(const ExpressionPtr& expression, const Environment& environment);
ConditionPtr substitute(const ConditionPtr& condition, const Environment& environment);

// Whether arithmetic may have no result, overflow of sums and products aside.
bool mayFail(const ExpressionPtr& expression);
bool mayFail(const ConditionPtr& condition);

} // namespace dotek::ir
