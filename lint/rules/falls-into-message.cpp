#include "lint/MacroNames.h"

#include <set>

namespace dotek::lint::rule {
namespace {

bool isMessage(const gibbs::Line& line) {
  const auto* command = line.statement ? std::get_if<gibbs::Command>(&line.statement->node) : nullptr;
  return command != nullptr && gibbs::foldCase(command->name.text) == "MESSAGE";
}

void check(const Project& project, Report& report) {
  for (const gibbs::Macro* macro : project.allMacros()) {
    const auto& lines = macro->lines;
    std::set<std::string> used;
    eachStatement(*macro, [&](const gibbs::Statement& statement) {
      if (const auto* jump = std::get_if<gibbs::Goto>(&statement.node))
        used.insert(gibbs::foldCase(jump->label.text));
    });
    // After the last message the end of the macro follows; where others jump, this one was to.
    std::size_t jumps = 0;
    const auto leads = [&](std::size_t i) {
      return i < lines.size() && lines[i].statement &&
             std::holds_alternative<gibbs::Goto>(lines[i].statement->node);
    };
    std::set<std::string> targets;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      if (!isMessage(lines[i]) || !leads(i + 1)) continue;
      ++jumps;
      targets.insert(gibbs::foldCase(std::get<gibbs::Goto>(lines[i + 1].statement->node).label.text));
    }
    for (std::size_t i = 0; i + 1 < lines.size() && jumps > 1; ++i) {
      const gibbs::Line& label = lines[i + 1];
      if (!isMessage(lines[i]) || !label.label || !used.contains(gibbs::foldCase(label.label->name.text)))
        continue;
      if (i + 2 < lines.size() && isMessage(lines[i + 2])) continue;
      // The others jump to this very label.
      if (targets.contains(gibbs::foldCase(label.label->name.text))) continue;
      report.at(lines[i].statement->range,
                "after this message the macro goes on with the values that it complains "
                "of; after the others it jumps away; write the GOTO");
    }
    for (std::size_t i = 0; i + 2 < lines.size(); ++i) {
      const gibbs::Line& label = lines[i + 1];
      if (!isMessage(lines[i]) || !label.label || label.statement || !isMessage(lines[i + 2])) continue;
      if (!used.contains(gibbs::foldCase(label.label->name.text))) continue;
      report
          .at(lines[i].statement->range, "after this message the macro goes on to the next one, which is "
                                         "for another mistake; the user sees "
                                         "both; write the GOTO that leads away")
          .note(lines[i + 2].statement->range, "the next message");
    }
  }
}

} // namespace

DOTEK_LINT_RULE(falls_into_message){
    .severity = Severity::Warning,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
