#include "ir/Walk.h"
#include "lint/Project.h"

#include <set>

namespace dotek::lint::rule {
namespace {

void collect(const ir::ConditionPtr& condition, std::set<ir::VariableId>& out) {
  ir::eachNode(condition, [&](const ir::Expression& node) {
    if (const auto* use = std::get_if<ir::VariableUse>(&node.node)) out.insert(use->variable);
  });
}

void check(const Project& project, Report& report) {
  for (const Joined& joined : project.joined) {
    if (!joined.lowered || !joined.checksLowered) continue;
    const ir::Cycle& cycle = *joined.lowered;
    std::set<ir::VariableId> checked;
    for (const ir::CycleStatement& statement : cycle.checks)
      if (const auto* branch = std::get_if<ir::Branch>(&statement.node)) collect(branch->condition, checked);
    if (checked.empty()) continue;
    std::set<ir::VariableId> told;
    for (const ir::CycleStatement& statement : cycle.body) {
      const auto* measure = std::get_if<ir::Measure>(&statement.node);
      if (measure == nullptr || measure->feature != ir::Feature::Surface || !measure->target) continue;
      if (measure->target->frame != ir::Frame::Here) continue;
      const auto* use = std::get_if<ir::VariableUse>(&measure->target->value->node);
      if (use == nullptr) continue;
      const ir::Variable& variable = cycle.variable(use->variable);
      // What the folder does not declare is another finding.
      if (variable.role != ir::Role::Parameter || !variable.defaultValue) continue;
      if (checked.contains(use->variable) || !told.insert(use->variable).second) continue;
      report
          .at(variable.range,
              "no check of the dialog looks at `{}`, the travel of a measurement; with 0, or less than "
              "the radius of the ball, the probe touches nothing or is in the part; compare it "
              "as the other travels",
              variable.name)
          .note(statement.origin.range(), "the measurement");
    }
  }
}

} // namespace

DOTEK_LINT_RULE(approach_unchecked){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .check = check,
};

} // namespace dotek::lint::rule
