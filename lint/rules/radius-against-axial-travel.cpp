#include "lint/MacroNames.h"

namespace dotek::lint::rule {
namespace {

struct Uses {
  std::set<std::string> radial, axial; // folded names in moves along X or Y, and along Z
};

Uses usesOf(const gibbs::Macro& toolPath) {
  Uses out;
  eachStatement(toolPath, [&](const gibbs::Statement& statement) {
    const auto* command = std::get_if<gibbs::Command>(&statement.node);
    if (command == nullptr || gibbs::foldCase(command->name.text) != "ADD_CUSTOM_DRILL_CYCLE_PATH") return;
    if (command->arguments.size() < 2) return;
    const gibbs::Name* kind = plainName(*command->arguments.front());
    const std::string word = kind == nullptr ? "" : gibbs::foldCase(kind->text);
    for (std::size_t i = 1; i < command->arguments.size(); ++i)
      (word == "FEED_Z" || (word == "FEED" && i == 3) ? out.axial : out.radial)
          .merge(readsOf(*command->arguments[i]));
  });
  return out;
}

void check(const Project& project, Report& report) {
  for (const gibbs::Cycle* cycle : project.cycles) {
    if (!cycle->cycleData || !cycle->toolPath || cycle->toolPath->hasErrorNodes) continue;
    const Uses uses = usesOf(*cycle->toolPath);
    const std::set<std::string> radius = radiusNames(*cycle->cycleData, project);
    eachStatement(*cycle->cycleData, [&](const gibbs::Statement& statement) {
      const gibbs::Comparison* comparison = onlyComparison(statement);
      if (comparison == nullptr) return;
      const gibbs::Name* travel = absoluteOf(*comparison->left);
      const gibbs::Name* limit = plainName(*comparison->right);
      if (travel == nullptr || limit == nullptr || !radius.contains(gibbs::foldCase(limit->text))) return;
      const std::string key = gibbs::foldCase(travel->text);
      if (!uses.axial.contains(key) || uses.radial.contains(key)) return;
      report.at(comparison->range,
                "`{}` is a travel along Z, where the radius of the ball plays no part; the check "
                "rejects travels that are long enough, or lets short ones pass; compare it "
                "with what the touch needs",
                travel->text);
    });
  }
}

} // namespace

DOTEK_LINT_RULE(radius_against_axial_travel){
    .severity = Severity::Note,
    .tier = Tier::Bundle,
    .check = check,
};

} // namespace dotek::lint::rule
