#include "lint/MacroNames.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>

namespace dotek::lint::rule {
namespace {

struct Numbers {
  std::map<double, SourceRange> set, compared;
  bool other = false; // set or compared differently
};

// The variable is declared GLOBAL here, or the macro calls others: what is not declared is global there, too.
bool shares(const gibbs::Macro& macro, const std::string& name) {
  bool out = false;
  eachStatement(macro, [&](const gibbs::Statement& statement) {
    out = out || std::holds_alternative<gibbs::CallMacro>(statement.node) ||
          std::holds_alternative<gibbs::Include>(statement.node);
    if (const auto* declared = std::get_if<gibbs::Declaration>(&statement.node))
      for (const gibbs::VariableRef& one : declared->names)
        out = out || gibbs::foldCase(one.name.text) == name;
  });
  return out;
}

void check(const Project& project, Report& report) {
  std::set<std::string> fields; // their values come from the user
  for (const gibbs::Cycle* cycle : project.cycles)
    fields.merge(fieldsOf(*cycle));
  const std::vector<const gibbs::Macro*> macros = project.allMacros();
  std::map<std::string, std::set<const gibbs::Macro*>> writers;
  for (const gibbs::Macro* macro : macros)
    for (const NameUse& use : namesOf(*macro, project))
      if (use.writes) writers[use.key].insert(macro);
  for (const gibbs::Macro* macro : macros) {
    if (macro->hasErrorNodes) continue;
    std::map<std::string, Numbers> all;
    eachStatement(*macro, [&](const gibbs::Statement& statement) {
      if (const auto* assign = std::get_if<gibbs::Assignment>(&statement.node)) {
        Numbers& numbers = all[gibbs::foldCase(assign->target.name.text)];
        const auto value = assign->value ? plainNumber(*assign->value) : std::nullopt;
        if (value)
          numbers.set.emplace(*value, statement.range);
        else
          numbers.other = true;
      } else if (const gibbs::Comparison* comparison = onlyComparison(statement)) {
        const gibbs::Name* name = plainName(*comparison->left);
        const auto value = plainNumber(*comparison->right);
        if (name == nullptr || !value) return;
        Numbers& numbers = all[gibbs::foldCase(name->text)];
        if (comparison->relation == gibbs::Relation::Equal)
          numbers.compared.emplace(*value, comparison->range);
        else if (*value != 0)
          numbers.other = true;
      }
    });
    for (const auto& [name, numbers] : all) {
      // What a called macro sets, or sees of this one, is not seen here.
      const auto written = writers.find(name);
      const bool elsewhere =
          written != writers.end() && written->second.size() > written->second.count(macro);
      if (elsewhere && shares(*macro, name)) continue;
      const auto isError = [](const auto& one) { return one.first != 0; };
      const bool codes = std::count_if(numbers.set.begin(), numbers.set.end(), isError) > 0 &&
                         std::count_if(numbers.compared.begin(), numbers.compared.end(), isError) > 0;
      if (numbers.other || fields.contains(name) || !codes ||
          numbers.set.size() + numbers.compared.size() < 4)
        continue;
      for (const auto& [value, range] : numbers.compared)
        if (value != 0 && !numbers.set.contains(value))
          report.at(range,
                    "nothing gives `{}` the value {}, so this never holds; a check that was meant to is "
                    "missing, or "
                    "has another number",
                    name, value);
      for (const auto& [value, range] : numbers.set)
        if (value != 0 && !numbers.compared.contains(value))
          report.at(range,
                    "nothing looks for the value {}, as for the others; what this check finds is not "
                    "reported; write "
                    "the message, or the number that is meant",
                    value);
    }
  }
}

} // namespace

DOTEK_LINT_RULE(error_number_unmatched){
    .severity = Severity::Warning,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
