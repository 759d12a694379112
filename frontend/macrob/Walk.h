// Visits the expressions of a block.
#pragma once

#include "frontend/macrob/Ast.h"

#include <functional>

namespace dotek::frontend::macrob {

// `subscript`: the expression is part of the number of a variable, #[..].
using VisitExpression = std::function<void(const Expression& expression, bool subscript)>;

// An expression and all within it, outer ones first.
void walk(const Expression& expression, const VisitExpression& visit, bool subscript = false);
void walk(const Condition& condition, const VisitExpression& visit);
// All expressions of a block: values of words, both sides of assignments (the number of the variable on the
// left counts as a subscript), conditions, targets.
void walk(const Block& block, const VisitExpression& visit);

// Comparisons of a condition, those that AND and OR join included, each with the place of its condition.
void eachComparison(const Condition& condition,
                    const std::function<void(const Comparison& comparison, SourceRange range)>& visit);

// Assignments of the block, also after THEN; nullptr: none.
const nc::Assignment* assignmentOf(const Block& block);
// Jumps of the block, also after IF and THEN; nullptr: none.
const Goto* gotoOf(const Block& block);
const Condition* conditionOf(const Block& block);

// Number of the variable where it is as digits: 5 of #5; nullopt: computed, or no variable.
std::optional<std::uint32_t> variableNumber(const Expression& expression);

} // namespace dotek::frontend::macrob
