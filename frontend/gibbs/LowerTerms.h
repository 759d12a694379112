// Sums of the IR as lists of signed terms, and what an expression reads.
#pragma once

#include "ir/Cycle.h"

#include <optional>
#include <set>
#include <vector>

namespace dotek::frontend::gibbs {

void collectVariables(const ir::ExpressionPtr& expression, std::set<ir::VariableId>& out);
void collectVariables(const ir::ConditionPtr& condition, std::set<ir::VariableId>& out);

struct Term {
  bool minus = false;
  ir::ExpressionPtr value; // no sum, no negation
};
// The terms of a sum in the order of the text; terms that cancel are gone, and so are zeros.
std::vector<Term> terms(const ir::ExpressionPtr& sum);
// Adds the term, or takes away one that it cancels.
void addTerm(std::vector<Term>& sum, bool minus, const ir::ExpressionPtr& value);
// The sum of the terms; 0 without any.
ir::ExpressionPtr sumOf(const std::vector<Term>& sum, SourceRange range);
// How often the variable is among the terms: with plus less with minus.
int count(const std::vector<Term>& sum, ir::VariableId variable);

} // namespace dotek::frontend::gibbs
