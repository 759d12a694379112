// Folding: a cycle with some parameters fixed.
#pragma once

#include "ir/Cycle.h"

#include <map>

namespace dotek::ir {

// x+0, 1*x, constants; `-0` never results. Keeps the digits of an untouched constant.
ExpressionPtr simplify(const ExpressionPtr& expression);
ConditionPtr simplify(const ConditionPtr& condition);

// Replaces the variables by the values in checks and body and simplifies: branches that are decided vanish
// with what nobody reaches, so do assignments to locals that nobody reads and labels without a jump. Locals
// are propagated as constants where every path to a use gives the same constant. A loop whose bounds are
// constants stays a loop unless `unroll`. A variable that is assigned in the cycle is replaced only until its
// first assignment. Variables keep their ids.
struct FoldOptions {
  bool unroll = false;
  std::uint32_t maxSteps = 100000; // of unrolling; more: the loop stays
};
void fold(Cycle& cycle, const std::map<VariableId, double>& values, const FoldOptions& options = {});

// Whether checks or body use the variable.
bool uses(const Cycle& cycle, VariableId variable);

} // namespace dotek::ir
