#include "lint/MacroNames.h"

#include <algorithm>

namespace dotek::lint::rule {
namespace {

bool callsOthers(const gibbs::Cycle& cycle) {
  bool calls = false;
  for (const gibbs::Macro* macro : macrosOf(cycle))
    eachStatement(*macro, [&](const gibbs::Statement& statement) {
      calls = calls || std::holds_alternative<gibbs::CallMacro>(statement.node) ||
              std::holds_alternative<gibbs::Include>(statement.node);
    });
  return calls;
}

void checkMacro(const gibbs::Macro& macro, const std::set<std::string>& read, const Project& project,
                Report& report) {
  std::set<std::string> told;
  for (const NameUse& use : namesOf(macro, project)) {
    if (!use.writes || use.reads || use.parameter || read.contains(use.key)) continue;
    if (project.gibbsKeywords.isSystemVariable(use.key) ||
        project.gibbsKeywords.callback(use.key) != nullptr ||
        project.gibbsKeywords.hasVariablePrefix(use.key))
      continue;
    if (!told.insert(use.key).second) continue;
    report.at(use.name->range,
              "`{}` gets a value here, and nothing reads it; take the line out, or use the value",
              use.name->text);
  }
}

void check(const Project& project, Report& report) {
  for (const gibbs::Cycle* cycle : project.cycles) {
    // A macro that is called may read what its caller set.
    if (callsOthers(*cycle)) continue;
    const std::vector<const gibbs::Macro*> macros = macrosOf(*cycle);
    if (std::any_of(macros.begin(), macros.end(), [](const gibbs::Macro* m) { return m->hasErrorNodes; }))
      continue;
    const std::set<std::string> fields = fieldsOf(*cycle);
    for (const gibbs::Macro* macro : macros) {
      // Each macro is run for itself; what it sets is read there, or is a field.
      std::set<std::string> read = fields;
      for (const NameUse& use : namesOf(*macro, project))
        if (use.reads) read.insert(use.key);
      const auto readExpression = [&](const gibbs::ExpressionPtr& e) {
        if (e) read.merge(readsOf(*e));
      };
      const auto readDialog = [&](const gibbs::Dialog& dialog) {
        for (const gibbs::Control& control : dialog.controls) {
          for (const gibbs::ExpressionPtr& argument : control.arguments)
            readExpression(argument);
          if (control.condition) {
            readExpression(control.condition->left);
            readExpression(control.condition->right);
          }
        }
      };
      if (cycle->dialog) readDialog(*cycle->dialog);
      for (const gibbs::Dialog* dialog : cycle->otherDialogs)
        readDialog(*dialog);
      checkMacro(*macro, read, project, report);
    }
  }
}

} // namespace

DOTEK_LINT_RULE(value_never_used){
    .severity = Severity::Note,
    .tier = Tier::Bundle,
    .check = check,
};

} // namespace dotek::lint::rule
