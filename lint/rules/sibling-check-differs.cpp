#include "lint/MacroNames.h"

#include <map>

namespace dotek::lint::rule {
namespace {

struct Found {
  const gibbs::Cycle* cycle = nullptr;
  SourceRange relation;
};

bool isStrict(gibbs::Relation relation) {
  return relation == gibbs::Relation::Less || relation == gibbs::Relation::Greater;
}
bool isOrdered(gibbs::Relation relation) {
  return relation != gibbs::Relation::Equal && relation != gibbs::Relation::NotEqual;
}

void check(const Project& project, Report& report) {
  // Comparisons of a travel with the radius of the tool, strict ones and others, by their sense.
  std::map<bool, std::map<bool, std::vector<Found>>> all;
  for (const gibbs::Cycle* cycle : project.cycles) {
    if (!cycle->cycleData) continue;
    const std::set<std::string> radius = radiusNames(*cycle->cycleData, project);
    eachStatement(*cycle->cycleData, [&](const gibbs::Statement& statement) {
      const gibbs::Comparison* comparison = onlyComparison(statement);
      if (comparison == nullptr || !isOrdered(comparison->relation)) return;
      const gibbs::Name* limit = plainName(*comparison->right);
      if (absoluteOf(*comparison->left) == nullptr || limit == nullptr ||
          !radius.contains(gibbs::foldCase(limit->text)))
        return;
      const bool less =
          comparison->relation == gibbs::Relation::Less || comparison->relation == gibbs::Relation::LessEqual;
      all[less][isStrict(comparison->relation)].push_back({cycle, comparison->relationRange});
    });
  }
  for (const auto& [less, forms] : all) {
    if (forms.size() < 2) continue;
    const auto cycles = [](const std::vector<Found>& found) {
      std::set<const gibbs::Cycle*> out;
      for (const Found& one : found)
        out.insert(one.cycle);
      return out.size();
    };
    const std::vector<Found>& strict = forms.at(true);
    const std::vector<Found>& other = forms.at(false);
    const bool strictIsRare = cycles(strict) < cycles(other);
    const std::vector<Found>& rare = strictIsRare ? strict : other;
    const std::vector<Found>& usual = strictIsRare ? other : strict;
    for (const Found& one : rare)
      report
          .at(one.relation,
              "this cycle compares a travel with the radius by `{}`, {} others by the form {} equality; "
              "a travel of exactly the radius passes in some of them; choose one",
              project.sources.textUtf8(one.relation), cycles(usual), strictIsRare ? "with" : "without")
          .note(usual.front().relation, "the other form");
  }
}

} // namespace

DOTEK_LINT_RULE(sibling_check_differs){
    .severity = Severity::Note,
    .byDefault = false,
    .tier = Tier::Bundle,
    .check = check,
};

} // namespace dotek::lint::rule
