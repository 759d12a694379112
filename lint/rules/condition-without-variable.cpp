#include "ir/Walk.h"
#include "lint/NcProgram.h"
#include "lint/Skips.h"

namespace dotek::lint::rule {
namespace {

bool isEmpty(const ir::ExpressionPtr& expression) {
  return std::holds_alternative<ir::NullValue>(expression->node) || variableNumber(*expression) == 0U;
}

bool isFixed(const ir::ExpressionPtr& expression) {
  bool fixed = true;
  ir::eachNode(expression, [&](const ir::Expression& node) {
    fixed = fixed && !std::holds_alternative<ir::MachineVariable>(node.node) &&
            !std::holds_alternative<ir::VariableUse>(node.node);
  });
  return fixed;
}

bool neverHolds(const ir::Comparison& comparison) {
  const double* left = ir::constantValue(comparison.left);
  const double* right = ir::constantValue(comparison.right);
  if (left == nullptr || right == nullptr) return false;
  switch (comparison.relation) {
  case ir::Relation::Less: return *left >= *right;
  case ir::Relation::LessEqual: return *left > *right;
  case ir::Relation::Greater: return *left <= *right;
  case ir::Relation::GreaterEqual: return *left < *right;
  case ir::Relation::Equal:
  case ir::Relation::NotEqual:
  case ir::Relation::Same:
  case ir::Relation::Different: return false;
  }
  return false;
}

void check(const NcProgram& nc, Report& report) {
  const ir::Program& program = nc.program;
  for (const ir::ProgramStatement& statement : program.body) {
    // WHILE [1 EQ 1] is meant.
    const auto* branch = std::get_if<ir::Branch>(&statement.node);
    const auto* loop = std::get_if<ir::Loop>(&statement.node);
    const ir::ConditionPtr* condition = branch != nullptr                    ? &branch->condition
                                        : loop != nullptr && loop->condition ? &loop->condition
                                                                             : nullptr;
    const auto* comparison =
        condition == nullptr ? nullptr : std::get_if<ir::Comparison>(&(*condition)->node);
    if (comparison == nullptr) continue;
    const bool left = isFixed(comparison->left) || isEmpty(comparison->left);
    const bool right = isFixed(comparison->right) || isEmpty(comparison->right);
    const bool plain = std::holds_alternative<ir::Constant>(comparison->left->node) &&
                       std::holds_alternative<ir::Constant>(comparison->right->node);
    // IF [1 EQ 1] and [1 EQ 0] switch blocks on and off.
    const bool meant = plain && (comparison->relation == ir::Relation::Equal ||
                                 comparison->relation == ir::Relation::NotEqual);
    if (!left || !right || meant) continue;
    // WHILE [1 GT 0] goes on for ever and is meant; one that never holds is not.
    if (loop != nullptr && (!plain || !neverHolds(*comparison))) continue;
    report.at(
        (*condition)->range.hasPlace() ? (*condition)->range : statement.origin.range(),
        "this condition looks at no variable, so it comes out the same each time; mostly the `#` of one "
        "is missing; write it");
  }
}

} // namespace

DOTEK_LINT_RULE(condition_without_variable){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
