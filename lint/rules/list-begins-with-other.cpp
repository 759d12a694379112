#include "frontend/gibbs/Check.h"
#include "lint/MacroNames.h"

#include <string>
#include <vector>

namespace dotek::lint::rule {
namespace {

void check(const Project& project, Report& report) {
  for (const gibbs::Dialog* dialog : project.allDialogs()) {
    std::vector<const gibbs::Name*> lists; // in the order of creation, which is their number
    const auto isOfAnother = [&](const std::string& name, std::size_t but) {
      for (std::size_t i = 0; i < lists.size(); ++i)
        if (i != but && lists[i] != nullptr && gibbs::foldCase(lists[i]->text) == name) return true;
      return false;
    };
    for (const gibbs::Control& control : dialog->controls)
      if (gibbs::foldCase(control.kind.text) == "DROPDOWN_NEW")
        lists.push_back(control.variable ? &*control.variable : nullptr);
    for (const gibbs::Control& control : dialog->controls) {
      if (gibbs::foldCase(control.kind.text) != "DROPDOWN_VAL" || control.arguments.size() != 2) continue;
      const auto number = gibbs::plainValue(*control.arguments[0]);
      const auto* first = std::get_if<gibbs::VariableRef>(&control.arguments[1]->node);
      if (!number || !(*number >= 1 && *number <= static_cast<double>(lists.size())) || first == nullptr)
        continue;
      const auto at = static_cast<std::size_t>(*number) - 1;
      const std::string name = gibbs::foldCase(first->name.text);
      if (lists[at] == nullptr || gibbs::foldCase(lists[at]->text) == name || !isOfAnother(name, at))
        continue;
      report
          .at(control.arguments[1]->range,
              "list {} sets `{}` and opens with the value of `{}`, which another list sets; write `{}`",
              at + 1, lists[at]->text, first->name.text, lists[at]->text)
          .note(lists[at]->range, "the field that the list sets");
    }
  }
}

} // namespace

DOTEK_LINT_RULE(list_begins_with_other){
    .severity = Severity::Warning,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
