#include "lint/MacroNames.h"

#include <map>

namespace dotek::lint::rule {
namespace {

void check(const Project& project, Report& report) {
  for (const Joined& joined : project.joined) {
    if (!joined.cycle->defineData) continue;
    std::map<std::string, const gibbs::Name*> spelt;
    for (const gibbs::Definition& definition : joined.cycle->defineData->definitions)
      spelt.emplace(gibbs::foldCase(definition.name.text), &definition.name);
    std::set<std::string> told;
    for (const compost::BranchRef& branch : compost::branchesOf(*joined.prog, joined.cycle->name)) {
      for (const compost::FieldRef& field :
           compost::fieldsPrinted(*joined.prog, branch, joined.cycle->name)) {
        const auto at = spelt.find(gibbs::foldCase(field.name));
        if (at == spelt.end() || at->second->text == field.name || !told.insert(field.name).second) continue;
        report
            .at(field.range,
                "the cycle `{}` spells this field `{}`; whether the post tells them apart is not known; "
                "write it alike",
                joined.cycle->name, at->second->text)
            .note(at->second->range, "declared here");
      }
    }
  }
}

} // namespace

DOTEK_LINT_RULE(field_case_differs){
    .severity = Severity::Warning,
    .tier = Tier::Bundle,
    .check = check,
};

} // namespace dotek::lint::rule
