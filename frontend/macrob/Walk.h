// Visits the expressions of a block.
#pragma once

#include "frontend/macrob/Ast.h"

#include <functional>
#include <optional>

namespace dotek::frontend::macrob {

// Comparisons of a condition, those that AND and OR join included, each with the place of its condition.
void eachComparison(const Condition& condition,
                    const std::function<void(const Comparison& comparison, SourceRange range)>& visit);

// Assignments of the block, also after THEN; nullptr: none.
const nc::Assignment* assignmentOf(const Block& block);
// Jumps of the block, also after IF and THEN; nullptr: none.
const Goto* gotoOf(const Block& block);
const Condition* conditionOf(const Block& block);

// An expression and all within it, outer ones first: `visit(expression, subscript)`, where `subscript` says
// that it is part of the number of a variable, #[..].
template <class Visit> void walk(const Expression& expression, const Visit& visit, bool subscript = false) {
  visit(expression, subscript);
  if (const auto* variable = std::get_if<nc::VariableRef>(&expression.node)) {
    walk(*variable->number, visit, true);
  } else if (const auto* negated = std::get_if<nc::Negated>(&expression.node)) {
    walk(*negated->operand, visit, subscript);
  } else if (const auto* operation = std::get_if<nc::Operation>(&expression.node)) {
    walk(*operation->left, visit, subscript);
    walk(*operation->right, visit, subscript);
  } else if (const auto* call = std::get_if<nc::FunctionCall>(&expression.node)) {
    for (const ExpressionPtr& argument : call->arguments)
      walk(*argument, visit, subscript);
  }
}

template <class Visit> void walk(const Condition& condition, const Visit& visit) {
  if (const auto* comparison = std::get_if<Comparison>(&condition.node)) {
    walk(*comparison->left, visit);
    walk(*comparison->right, visit);
  } else if (const auto* joined = std::get_if<JoinedConditions>(&condition.node)) {
    walk(*joined->left, visit);
    walk(*joined->right, visit);
  }
}

// All expressions of a block: values of words, both sides of assignments (the number of the variable on the
// left counts as a subscript), conditions, targets.
template <class Visit> void walk(const Block& block, const Visit& visit) {
  if (const auto* words = std::get_if<Words>(&block.body))
    for (const nc::Word& word : words->words)
      if (word.value != nullptr) walk(*word.value, visit);
  if (const Condition* condition = conditionOf(block)) walk(*condition, visit);
  if (const nc::Assignment* assignment = assignmentOf(block)) {
    walk(*assignment->variable, visit, true);
    walk(*assignment->value, visit);
  }
  if (const Goto* jump = gotoOf(block)) walk(*jump->target, visit);
}

// Number of the variable where it is as digits: 5 of #5; nullopt: computed, or no variable.
std::optional<std::uint32_t> variableNumber(const Expression& expression);

} // namespace dotek::frontend::macrob
