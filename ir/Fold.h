// Folding: a cycle with some parameters fixed.
#pragma once

#include "ir/Cycle.h"

#include <map>
#include <set>

namespace dotek::ir {

// x+0, 1*x, constants; `-0` never results. Exact: the value is the same double whatever the variables are, so
// (a + 1) + 2 stays. Operands of arithmetic are taken to be no null, as verify() demands. Keeps the digits of
// an untouched constant, and of a negated one. What has no value (1/0) stays as it is.
ExpressionPtr simplify(const ExpressionPtr& expression);
ConditionPtr simplify(const ConditionPtr& condition);

// Replaces the variables by the values in checks and body and simplifies: branches that are decided vanish
// with what nobody reaches, so do assignments that nobody reads (unless their arithmetic may fail), labels
// without a jump and jumps to what follows anyway. Variables are propagated as constants (or as null) where
// every path to a use gives the same one; the body begins with what the checks leave. A loop whose bounds are
// constants stays a loop unless `unroll`: then a list in which it is decided how often each loop runs becomes
// the statements in the order in which they run, and goes forward only. Variables keep their ids.
struct FoldOptions {
  bool unroll = false;
  std::uint32_t maxSteps = 100000; // of unrolling; more: the loop stays
  std::set<VariableId> read = {};  // beside checks and body, by a text that is printed: assigned as before
};
void fold(Cycle& cycle, const std::map<VariableId, double>& values, const FoldOptions& options = {});

// Whether checks or body read or assign the variable.
bool uses(const Cycle& cycle, VariableId variable);

} // namespace dotek::ir
