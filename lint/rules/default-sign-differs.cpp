#include "lint/MacroNames.h"

#include <map>

namespace dotek::lint::rule {
namespace {

constexpr std::size_t kLeast = 2; // other cycles that agree

void check(const Project& project, Report& report) {
  std::map<std::string, std::vector<const gibbs::Definition*>> all;
  for (const gibbs::Cycle* cycle : project.cycles) {
    if (!cycle->defineData) continue;
    for (const gibbs::Definition& definition : cycle->defineData->definitions)
      if (definition.number && *definition.number != 0)
        all[gibbs::foldCase(definition.name.text)].push_back(&definition);
  }
  for (const auto& [name, definitions] : all) {
    if (definitions.size() <= kLeast) continue;
    std::vector<const gibbs::Definition*> negative, positive;
    for (const gibbs::Definition* one : definitions)
      (*one->number < 0 ? negative : positive).push_back(one);
    const auto& few = negative.size() < positive.size() ? negative : positive;
    const auto& many = negative.size() < positive.size() ? positive : negative;
    if (few.size() != 1) continue;
    report
        .at(few.front()->valueRange,
            "`{}` begins {} here and {} in the other cycles; a sign is easily lost, and it turns the path "
            "round",
            few.front()->name.text, *few.front()->number < 0 ? "below 0" : "above 0",
            *few.front()->number < 0 ? "above" : "below")
        .note(many.front()->valueRange, "as in this one");
  }
}

} // namespace

DOTEK_LINT_RULE(default_sign_differs){
    .severity = Severity::Note,
    .byDefault = false,
    .tier = Tier::Bundle,
    .check = check,
};

} // namespace dotek::lint::rule
