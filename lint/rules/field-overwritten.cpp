#include "lint/MacroNames.h"

namespace dotek::lint::rule {
namespace {

void check(const Project& project, Report& report) {
  for (const gibbs::Cycle* cycle : project.cycles) {
    const std::set<std::string> fields = fieldsOf(*cycle);
    for (const gibbs::Macro* macro : macrosOf(*cycle)) {
      eachStatement(*macro, [&](const gibbs::Statement& statement) {
        const auto* command = std::get_if<gibbs::Command>(&statement.node);
        if (command == nullptr || command->arguments.size() < 2) return;
        if (!gibbs::foldCase(command->name.text).starts_with("GET_")) return;
        const gibbs::Name* name = plainName(*command->arguments.back());
        if (name == nullptr || !fields.contains(gibbs::foldCase(name->text))) return;
        report.at(
            name->range,
            "the command writes into `{}`, which is a field of the cycle; what the user typed is lost; write "
            "the variable that is meant",
            name->text);
      });
    }
  }
}

} // namespace

DOTEK_LINT_RULE(field_overwritten){
    .severity = Severity::Warning,
    .tier = Tier::Bundle,
    .check = check,
};

} // namespace dotek::lint::rule
