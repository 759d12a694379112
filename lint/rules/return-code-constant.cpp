#include "lint/MacroNames.h"

namespace dotek::lint::rule {
namespace {

void check(const Project& project, Report& report) {
  for (const gibbs::Cycle* cycle : project.cycles) {
    std::vector<SourceRange> zeros;
    bool other = false;
    for (const gibbs::Macro* macro : macrosOf(*cycle)) {
      eachStatement(*macro, [&](const gibbs::Statement& statement) {
        const auto* assign = std::get_if<gibbs::Assignment>(&statement.node);
        if (assign == nullptr || gibbs::foldCase(assign->target.name.text) != "CALLBACK_RETURNCODE") return;
        const auto value = assign->value ? plainNumber(*assign->value) : std::nullopt;
        if (value && *value == 0)
          zeros.push_back(statement.range);
        else
          other = true;
      });
    }
    if (other) continue;
    for (const SourceRange range : zeros)
      report.at(
          range,
          "callback_returncode is set to 0 and never to an error; GibbsCAM takes every end of the macro "
          "for a success; set another value where it fails");
  }
}

} // namespace

DOTEK_LINT_RULE(return_code_constant){
    .severity = Severity::Note,
    .byDefault = false,
    .tier = Tier::Bundle,
    .check = check,
};

} // namespace dotek::lint::rule
