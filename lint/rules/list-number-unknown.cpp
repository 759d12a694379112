#include "frontend/gibbs/Check.h"
#include "lint/MacroNames.h"
#include "support/Decimal.h"

#include <cmath>

namespace dotek::lint::rule {
namespace {

void check(const Project& project, Report& report) {
  for (const gibbs::Dialog* dialog : project.allDialogs()) {
    if (dialog->hasErrorNodes) continue;
    double made = 0;
    for (const gibbs::Control& control : dialog->controls)
      if (gibbs::foldCase(control.kind.text) == "DROPDOWN_NEW") ++made;
    for (const gibbs::Control& control : dialog->controls) {
      const std::string kind = gibbs::foldCase(control.kind.text);
      if ((kind != "DROPDOWN_ADD" && kind != "DROPDOWN_VAL") || control.arguments.empty()) continue;
      const auto number = gibbs::plainValue(*control.arguments[0]);
      if (!number || (*number >= 1 && *number <= made && *number == std::trunc(*number))) continue;
      report.at(control.arguments[0]->range,
                "there is no list {}: this dialog creates {}; the entry is lost, and the list that was meant "
                "offers one less; write its number, in the order of `DROPDOWN_NEW`",
                numberText(*number),
                made == 0   ? "none"
                : made == 1 ? "one"
                            : numberText(made));
    }
  }
}

} // namespace

DOTEK_LINT_RULE(list_number_unknown){
    .severity = Severity::Warning,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
