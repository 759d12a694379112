#include "frontend/gibbs/Check.h"
#include "lint/MacroNames.h"

#include <algorithm>
#include <map>
#include <vector>

namespace dotek::lint::rule {
namespace {

struct Entry {
  const gibbs::Control* control = nullptr;
  double value = 0;
  std::string text;
};

std::string captionOf(const gibbs::Expression& expression) {
  const auto* text = std::get_if<gibbs::TextLiteral>(&expression.node);
  return text == nullptr ? std::string() : gibbs::foldCase(text->text);
}

void check(const Project& project, Report& report) {
  for (const gibbs::Dialog* dialog : project.allDialogs()) {
    std::map<double, std::vector<Entry>> lists; // by their number
    for (const gibbs::Control& control : dialog->controls) {
      if (gibbs::foldCase(control.kind.text) != "DROPDOWN_ADD" || control.arguments.size() != 3) continue;
      const auto number = gibbs::plainValue(*control.arguments[0]);
      const auto value = gibbs::plainValue(*control.arguments[2]);
      if (!number || !value) continue;
      std::vector<Entry>& entries = lists[*number];
      const Entry entry{&control, *value, captionOf(*control.arguments[1])};
      const auto same = std::find_if(entries.begin(), entries.end(), [&](const Entry& one) {
        return one.value == entry.value || (!entry.text.empty() && one.text == entry.text);
      });
      if (same != entries.end()) {
        const bool ofValue = same->value == entry.value;
        report
            .at(control.range, "two entries of this list {}, so {}; give one of them another {}",
                ofValue ? "give the field the same value" : "have the same text",
                ofValue ? "the macro cannot tell them apart" : "nobody can tell them apart",
                ofValue ? "value" : "text")
            .note(same->control->range, "the other one");
      }
      entries.push_back(entry);
    }
  }
}

} // namespace

DOTEK_LINT_RULE(list_entry_twice){
    .severity = Severity::Warning,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
