#include "ir/Rewrite.h"

namespace dotek::ir {
namespace {

template <class... Types> struct Cases : Types... { using Types::operator()...; };

void rewriteAll(const std::vector<ExpressionPtr*>& roots, const Rewriter& rewriter) {
  for (ExpressionPtr* root : roots) {
    if (*root != nullptr) *root = rewrite(*root, rewriter);
  }
}

void rewriteCoordinate(std::optional<Coordinate>& coordinate, const Rewriter& rewriter) {
  if (coordinate) rewriteAll({&coordinate->value, &coordinate->system}, rewriter);
}

} // namespace

ExpressionPtr rewrite(const ExpressionPtr& expression, const Rewriter& rewriter) {
  if (const auto* one = std::get_if<Unary>(&expression->node)) {
    const ExpressionPtr operand = rewrite(one->operand, rewriter);
    return rewriter(operand == one->operand ? expression : unary(one->op, operand, expression->range));
  }
  if (const auto* two = std::get_if<Binary>(&expression->node)) {
    const ExpressionPtr left = rewrite(two->left, rewriter);
    const ExpressionPtr right = rewrite(two->right, rewriter);
    const bool same = left == two->left && right == two->right;
    return rewriter(same ? expression : binary(two->op, left, right, expression->range));
  }
  if (const auto* machine = std::get_if<MachineVariable>(&expression->node)) {
    const ExpressionPtr number = rewrite(machine->number, rewriter);
    if (number == machine->number) return rewriter(expression);
    return rewriter(
        std::make_shared<const Expression>(Expression{expression->range, MachineVariable{number}}));
  }
  return rewriter(expression);
}

ConditionPtr rewrite(const ConditionPtr& condition, const Rewriter& rewriter) {
  return std::visit(
      Cases{[&](const Comparison& c) {
              return compare(c.relation, rewrite(c.left, rewriter), rewrite(c.right, rewriter),
                             condition->range);
            },
            [&](const IsNull& c) { return isNull(rewrite(c.value, rewriter), condition->range); },
            [&](const Not& c) {
              return std::make_shared<const Condition>(
                  Condition{condition->range, Not{rewrite(c.inner, rewriter)}});
            },
            [&](const Junction& c) {
              return join(c.op, rewrite(c.left, rewriter), rewrite(c.right, rewriter), condition->range);
            },
            [&](const Truth&) { return condition; }},
      condition->node);
}

void rewrite(Statement& statement, const Rewriter& rewriter) {
  std::visit(Cases{[&](Assign& s) { rewriteAll({&s.value}, rewriter); },
                   [&](Store& s) {
                     rewriteAll({&s.number, &s.value}, rewriter);
                   },
                   [&](Branch& s) { s.condition = rewrite(s.condition, rewriter); },
                   [&](Move& s) {
                     for (std::optional<Coordinate>& axis : s.axes)
                       rewriteCoordinate(axis, rewriter);
                     rewriteAll({&s.feed}, rewriter);
                   },
                   [&](Measure& s) {
                     rewriteCoordinate(s.target, rewriter);
                     rewriteAll({&s.diameter}, rewriter);
                     if (!s.setting) return;
                     rewriteAll({&s.setting->system}, rewriter);
                     for (ExpressionPtr& nominal : s.setting->nominal)
                       rewriteAll({&nominal}, rewriter);
                   },
                   [&](Spindle& s) { rewriteAll({&s.speed}, rewriter); },
                   [&](SetMode& s) { rewriteAll({&s.system}, rewriter); },
                   [&](Dwell& s) { rewriteAll({&s.seconds}, rewriter); },
                   [&](OpaqueBlock& s) {
                     for (Word& word : s.words)
                       rewriteAll({&word.value}, rewriter);
                   },
                   [](Label&) {}, [](Jump&) {}, [](Return&) {}, [](ProbePower&) {}, [](Coolant&) {},
                   [](Stop&) {}, [](Alarm&) {}, [](Comment&) {}, [](std::monostate&) {}},
             statement.node);
}

void rename(std::vector<Statement>& list, const std::map<VariableId, VariableId>& names) {
  const Rewriter renamed = [&](const ExpressionPtr& expression) {
    const auto* use = std::get_if<VariableUse>(&expression->node);
    const auto found = use == nullptr ? names.end() : names.find(use->variable);
    return found == names.end() ? expression : variable(found->second, expression->range);
  };
  for (Statement& statement : list) {
    rewrite(statement, renamed);
    if (auto* assign = std::get_if<Assign>(&statement.node)) {
      if (const auto found = names.find(assign->variable); found != names.end())
        assign->variable = found->second;
    }
  }
}

std::set<double> constantsOf(const std::vector<Statement>& list) {
  std::set<double> out;
  const Rewriter collect = [&](const ExpressionPtr& expression) {
    if (const double* value = constantValue(expression)) out.insert(*value);
    return expression;
  };
  for (Statement statement : list)
    rewrite(statement, collect);
  return out;
}

} // namespace dotek::ir
