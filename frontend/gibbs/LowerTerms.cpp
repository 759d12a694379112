#include "frontend/gibbs/LowerTerms.h"

#include <algorithm>

namespace dotek::frontend::gibbs {
namespace {

void split(const ir::ExpressionPtr& sum, bool minus, std::vector<Term>& out) {
  if (const auto* unary = std::get_if<ir::Unary>(&sum->node);
      unary != nullptr && unary->op == ir::UnaryOp::Negate)
    return split(unary->operand, !minus, out);
  const auto* binary = std::get_if<ir::Binary>(&sum->node);
  if (binary != nullptr && (binary->op == ir::BinaryOp::Add || binary->op == ir::BinaryOp::Subtract)) {
    split(binary->left, minus, out);
    return split(binary->right, minus != (binary->op == ir::BinaryOp::Subtract), out);
  }
  addTerm(out, minus, sum);
}

} // namespace

void collectVariables(const ir::ExpressionPtr& expression, std::set<ir::VariableId>& out) {
  if (!expression) return;
  if (const auto* use = std::get_if<ir::VariableUse>(&expression->node)) out.insert(use->variable);
  if (const auto* unary = std::get_if<ir::Unary>(&expression->node)) collectVariables(unary->operand, out);
  if (const auto* binary = std::get_if<ir::Binary>(&expression->node)) {
    collectVariables(binary->left, out);
    collectVariables(binary->right, out);
  }
}

void collectVariables(const ir::ConditionPtr& condition, std::set<ir::VariableId>& out) {
  if (!condition) return;
  if (const auto* comparison = std::get_if<ir::Comparison>(&condition->node)) {
    collectVariables(comparison->left, out);
    collectVariables(comparison->right, out);
  }
  if (const auto* inverted = std::get_if<ir::Not>(&condition->node)) collectVariables(inverted->inner, out);
  if (const auto* junction = std::get_if<ir::Junction>(&condition->node)) {
    collectVariables(junction->left, out);
    collectVariables(junction->right, out);
  }
}

std::vector<Term> terms(const ir::ExpressionPtr& sum) {
  std::vector<Term> out;
  split(sum, false, out);
  return out;
}

void addTerm(std::vector<Term>& sum, bool minus, const ir::ExpressionPtr& value) {
  const double* constant = ir::constantValue(value);
  if (constant != nullptr && *constant == 0) return;
  const auto found = std::find_if(sum.begin(), sum.end(), [&](const Term& term) {
    return term.minus != minus && ir::equal(term.value, value);
  });
  if (found != sum.end()) {
    sum.erase(found);
  } else {
    sum.push_back({minus, value});
  }
}

ir::ExpressionPtr sumOf(const std::vector<Term>& sum, SourceRange range) {
  if (sum.empty()) return ir::constant(0, range, "0");
  // A sum begins with a positive term where it has one.
  const auto first = std::find_if(sum.begin(), sum.end(), [](const Term& term) { return !term.minus; });
  ir::ExpressionPtr out;
  if (first != sum.end()) {
    out = first->value;
  } else {
    out = ir::unary(ir::UnaryOp::Negate, sum.front().value, range);
  }
  for (auto term = sum.begin(); term != sum.end(); ++term) {
    if (term == first || (first == sum.end() && term == sum.begin())) continue;
    out = ir::binary(term->minus ? ir::BinaryOp::Subtract : ir::BinaryOp::Add, out, term->value, range);
  }
  return out;
}

int count(const std::vector<Term>& sum, ir::VariableId variable) {
  int times = 0;
  for (const Term& term : sum) {
    const auto* use = std::get_if<ir::VariableUse>(&term.value->node);
    if (use != nullptr && use->variable == variable) times += term.minus ? -1 : 1;
  }
  return times;
}

} // namespace dotek::frontend::gibbs
