#include "lint/MacroNames.h"

#include <map>
#include <set>

namespace dotek::lint::rule {
namespace {

struct Check {
  std::string field; // folded: what is compared with a number
  double number = 0; // that is stored
  SourceRange range;
};

void checkCycle(const gibbs::Cycle& cycle, Report& report) {
  if (!cycle.cycleData || cycle.cycleData->hasErrorNodes) return;
  const std::set<std::string> fields = fieldsOf(cycle);
  std::map<std::string, std::vector<Check>> all; // by the variable that is set
  eachStatement(*cycle.cycleData, [&](const gibbs::Statement& statement) {
    const gibbs::Comparison* comparison = onlyComparison(statement);
    const auto* branch = std::get_if<gibbs::If>(&statement.node);
    if (comparison == nullptr || !branch->then) return;
    const auto* assign = std::get_if<gibbs::Assignment>(&branch->then->node);
    const auto number = assign != nullptr && assign->value ? plainNumber(*assign->value) : std::nullopt;
    if (!number || *number == 0) return;
    std::string field;
    bool several = false; // a relation of two fields is nobody's range
    for (const auto* side : {comparison->left.get(), comparison->right.get()})
      for (const std::string& name : readsOf(*side))
        if (fields.contains(name)) {
          several = several || (!field.empty() && field != name);
          field = name;
        }
    if (!field.empty() && !several)
      all[gibbs::foldCase(assign->target.name.text)].push_back({field, *number, branch->then->range});
  });
  for (const auto& [variable, checks] : all) {
    std::map<double, std::set<std::string>> byNumber;
    std::map<std::string, std::map<double, std::size_t>> byField;
    for (const Check& check : checks) {
      byNumber[check.number].insert(check.field);
      ++byField[check.field][check.number];
    }
    // One number for checks of two fields, of which one has a number of its own: the numbers were mixed up.
    for (const Check& check : checks) {
      if (byNumber[check.number].size() < 2 || byField[check.field].size() < 2) continue;
      bool own = false;
      for (const auto& [number, count] : byField[check.field])
        own = own || (number != check.number && byNumber[number].size() == 1);
      if (own)
        report.at(
            check.range,
            "this number is that of a check on another field, and another check on `{}` has a number of its "
            "own; the user reads the wrong message; write the number of this field",
            check.field);
    }
  }
}

void check(const Project& project, Report& report) {
  for (const gibbs::Cycle* cycle : project.cycles)
    checkCycle(*cycle, report);
}

} // namespace

DOTEK_LINT_RULE(error_number_of_other_check){
    .severity = Severity::Warning,
    .tier = Tier::Bundle,
    .check = check,
};

} // namespace dotek::lint::rule
