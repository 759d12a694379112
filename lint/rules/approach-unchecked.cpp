#include "ir/Walk.h"
#include "lint/Project.h"

#include <algorithm>
#include <map>
#include <set>
#include <vector>

namespace dotek::lint::rule {
namespace {

template <class Tree> void collect(const Tree& condition, std::set<ir::VariableId>& out) {
  ir::eachNode(condition, [&](const ir::Expression& node) {
    if (const auto* use = std::get_if<ir::VariableUse>(&node.node)) out.insert(use->variable);
  });
}

// Adds what the variables of `out` are computed from.
void spread(const std::map<ir::VariableId, std::set<ir::VariableId>>& computedFrom,
            std::set<ir::VariableId>& out) {
  std::vector<ir::VariableId> open(out.begin(), out.end());
  while (!open.empty()) {
    const auto from = computedFrom.find(open.back());
    open.pop_back();
    if (from == computedFrom.end()) continue;
    for (const ir::VariableId one : from->second)
      if (out.insert(one).second) open.push_back(one);
  }
}

void check(const Project& project, Report& report) {
  for (const Joined& joined : project.joined) {
    if (!joined.lowered || !joined.checksLowered) continue;
    const ir::Cycle& cycle = *joined.lowered;
    std::set<ir::VariableId> checked;
    std::map<ir::VariableId, std::set<ir::VariableId>> computedFrom;
    for (const ir::CycleStatement& statement : cycle.checks) {
      if (const auto* branch = std::get_if<ir::Branch>(&statement.node)) collect(branch->condition, checked);
      if (const auto* assign = std::get_if<ir::Assign>(&statement.node))
        collect(assign->value, computedFrom[assign->variable]);
    }
    if (checked.empty()) continue;
    // A check of what is computed, an argument of a called macro too, looks at what it is computed from; and
    // the travel that is computed is as good as the fields that it comes from.
    spread(computedFrom, checked);
    for (const auto& [variable, from] : computedFrom)
      if (std::any_of(from.begin(), from.end(), [&](ir::VariableId one) { return checked.contains(one); }))
        checked.insert(variable);
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
