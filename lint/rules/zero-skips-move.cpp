#include "lint/MacroNames.h"

#include <map>

namespace dotek::lint::rule {
namespace {

struct Sides {
  const gibbs::Comparison* positive = nullptr;
  const gibbs::Comparison* negative = nullptr;
  bool other = false; // a comparison that takes 0
};

std::map<std::string, Sides> sidesOf(const gibbs::Macro& toolPath) {
  std::map<std::string, Sides> out;
  eachStatement(toolPath, [&](const gibbs::Statement& statement) {
    const gibbs::Comparison* comparison = onlyComparison(statement);
    if (comparison == nullptr) return;
    const gibbs::Name* name = plainName(*comparison->left);
    const auto bound = plainNumber(*comparison->right);
    if (name == nullptr || !bound || *bound != 0) return;
    Sides& sides = out[gibbs::foldCase(name->text)];
    if (commandName(statement) != "ADD_CUSTOM_DRILL_CYCLE_PATH") {
      sides.other = true;
    } else if (comparison->relation == gibbs::Relation::Greater) {
      sides.positive = comparison;
    } else if (comparison->relation == gibbs::Relation::Less) {
      sides.negative = comparison;
    } else {
      sides.other = true;
    }
  });
  return out;
}

// CycleData.mac looks at 0: ABS(v) <= anything, ABS(v) < a number above 0, v = 0, v <= 0.
bool turnsZeroAway(const gibbs::Macro& checks, const std::string& key) {
  bool found = false;
  eachStatement(checks, [&](const gibbs::Statement& statement) {
    const auto* branch = std::get_if<gibbs::If>(&statement.node);
    if (branch == nullptr) return;
    for (const gibbs::Comparison& comparison : branch->condition.comparisons) {
      if (!comparison.left || !comparison.right) continue;
      const gibbs::Name* absolute = absoluteOf(*comparison.left);
      const gibbs::Name* plain = plainName(*comparison.left);
      const auto bound = plainNumber(*comparison.right);
      const auto relation = comparison.relation;
      if (absolute != nullptr && gibbs::foldCase(absolute->text) == key) {
        if (relation == gibbs::Relation::LessEqual || relation == gibbs::Relation::Equal) found = true;
        if (relation == gibbs::Relation::Less && bound && *bound > 0) found = true;
      }
      if (plain != nullptr && gibbs::foldCase(plain->text) == key && bound) {
        if (*bound == 0 && relation != gibbs::Relation::Less && relation != gibbs::Relation::Greater)
          found = true;
        if (relation == gibbs::Relation::Less && *bound > 0) found = true;
        if (relation == gibbs::Relation::Greater && *bound < 0) found = true;
      }
    }
  });
  return found;
}

void check(const Project& project, Report& report) {
  for (const gibbs::Cycle* cycle : project.cycles) {
    if (!cycle->toolPath) continue;
    for (const auto& [key, sides] : sidesOf(*cycle->toolPath)) {
      if (sides.positive == nullptr || sides.negative == nullptr || sides.other) continue;
      if (cycle->cycleData && turnsZeroAway(*cycle->cycleData, key)) continue;
      report
          .at(sides.positive->range,
              "for 0 neither this move nor its counterpart is drawn, and the dialog lets 0 pass; "
              "the touch is missing from the path; reject 0, or give it a side")
          .note(sides.negative->range, "the counterpart");
    }
  }
}

} // namespace

DOTEK_LINT_RULE(zero_skips_move){
    .severity = Severity::Note,
    .byDefault = false,
    .tier = Tier::Bundle,
    .check = check,
};

} // namespace dotek::lint::rule
