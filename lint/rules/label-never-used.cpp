#include "lint/MacroNames.h"

#include <algorithm>

namespace dotek::lint::rule {
namespace {

void check(const Project& project, Report& report) {
  for (const gibbs::Macro* macro : project.allMacros()) {
    std::set<std::string> used;
    bool includes = false;
    eachStatement(*macro, [&](const gibbs::Statement& statement) {
      if (const auto* jump = std::get_if<gibbs::Goto>(&statement.node))
        used.insert(gibbs::foldCase(jump->label.text));
      if (const auto* handler = std::get_if<gibbs::OnError>(&statement.node))
        used.insert(gibbs::foldCase(handler->label.text));
      includes = includes || std::holds_alternative<gibbs::Include>(statement.node);
    });
    std::set<std::string> labels;
    for (const gibbs::Line& line : macro->lines)
      if (line.label) labels.insert(gibbs::foldCase(line.label->name.text));
    // A GOTO to a label that is not there is reported already, and is the likely cause.
    if (!std::includes(labels.begin(), labels.end(), used.begin(), used.end())) continue;
    // A label may be for a file that includes this one, or one that it includes.
    if (includes || macro->hasErrorNodes || used.empty()) continue;
    for (const gibbs::Line& line : macro->lines) {
      if (!line.label || used.contains(gibbs::foldCase(line.label->name.text))) continue;
      report.at(line.label->name.range,
                "no GOTO goes to the label `{}`; one is missing, or the label is left over",
                line.label->name.text);
    }
  }
}

} // namespace

DOTEK_LINT_RULE(label_never_used){
    .severity = Severity::Note,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
