#include "lint/MacroNames.h"

namespace dotek::lint::rule {
namespace {

void check(const Project& project, Report& report) {
  for (const gibbs::Cycle* cycle : project.cycles) {
    std::set<std::string> variables = fieldsOf(*cycle);
    for (const gibbs::Macro* macro : macrosOf(*cycle))
      for (const NameUse& use : namesOf(*macro, project))
        if (use.reads || use.writes) variables.insert(use.key);
    for (const gibbs::Macro* macro : macrosOf(*cycle)) {
      for (const NameUse& use : namesOf(*macro, project)) {
        if (!use.parameter || !variables.contains(use.key)) continue;
        report.at(use.name->range,
                  "`{}` is the name of a value of GibbsCAM here, not the variable `{}` of this cycle; "
                  "the variable is not read; another spelling would show it",
                  use.name->text, use.key);
      }
    }
  }
}

} // namespace

DOTEK_LINT_RULE(parameter_like_variable){
    .severity = Severity::Note,
    .byDefault = false,
    .tier = Tier::Bundle,
    .check = check,
};

} // namespace dotek::lint::rule
