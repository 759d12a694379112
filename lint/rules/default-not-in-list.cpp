#include "frontend/gibbs/Check.h"
#include "lint/MacroNames.h"
#include "support/Decimal.h"

#include <algorithm>
#include <string>
#include <vector>

namespace dotek::lint::rule {
namespace {

struct List {
  const gibbs::Name* field = nullptr;
  bool known = true; // each entry has a written value
  std::vector<double> values;
};

void checkCycle(const gibbs::Cycle& cycle, Report& report) {
  std::vector<List> lists; // in the order of creation, which is their number
  for (const gibbs::Control& control : cycle.dialog->controls)
    if (gibbs::foldCase(control.kind.text) == "DROPDOWN_NEW")
      lists.push_back({control.variable ? &*control.variable : nullptr, true, {}});
  for (const gibbs::Control& control : cycle.dialog->controls) {
    if (gibbs::foldCase(control.kind.text) != "DROPDOWN_ADD" || control.arguments.size() != 3) continue;
    const auto number = gibbs::plainValue(*control.arguments[0]);
    const auto value = gibbs::plainValue(*control.arguments[2]);
    if (!number || !(*number >= 1 && *number <= static_cast<double>(lists.size()))) return; // another rule's
    List& list = lists[static_cast<std::size_t>(*number) - 1];
    list.known = list.known && value.has_value();
    if (value) list.values.push_back(*value);
  }
  for (const List& list : lists) {
    if (list.field == nullptr || !list.known || list.values.empty()) continue;
    for (const gibbs::Definition& definition : cycle.defineData->definitions) {
      if (gibbs::foldCase(definition.name.text) != gibbs::foldCase(list.field->text) || !definition.number)
        continue;
      if (std::find(list.values.begin(), list.values.end(), *definition.number) != list.values.end())
        continue;
      report
          .at(definition.valueRange,
              "no entry of the list of `{}` has the value {}; the dialog opens without one, and the post "
              "prints what nobody can choose; write the value of an entry",
              definition.name.text, numberText(*definition.number))
          .note(list.field->range, "the list");
    }
  }
}

void check(const Project& project, Report& report) {
  for (const gibbs::Cycle* cycle : project.cycles)
    if (cycle->defineData && cycle->dialog && !cycle->dialog->hasErrorNodes) checkCycle(*cycle, report);
}

} // namespace

DOTEK_LINT_RULE(default_not_in_list){
    .severity = Severity::Warning,
    .tier = Tier::Bundle,
    .check = check,
};

} // namespace dotek::lint::rule
