// Rewriting expressions inside statements; visiting them is Walk.h.
#pragma once

#include "ir/Cycle.h"

#include <functional>
#include <map>
#include <set>
#include <vector>

namespace dotek::ir {

// Given a node whose operands are rewritten already; gives the node that takes its place.
using Rewriter = std::function<ExpressionPtr(const ExpressionPtr&)>;

ExpressionPtr rewrite(const ExpressionPtr& expression, const Rewriter& rewriter);
ConditionPtr rewrite(const ConditionPtr& condition, const Rewriter& rewriter);
// Every expression that the statement reads.
void rewrite(CycleStatement& statement, const Rewriter& rewriter);
void rewrite(ProgramStatement& statement, const Rewriter& rewriter);

// Uses and assignments of each key become those of its value; the rest stays.
void rename(std::vector<CycleStatement>& list, const std::map<VariableId, VariableId>& names);
// The constants that the statements name.
std::set<double> constantsOf(const std::vector<CycleStatement>& list);

} // namespace dotek::ir
