#include "lint/MacroNames.h"

#include <algorithm>
#include <map>
#include <set>

namespace dotek::lint::rule {
namespace {

const gibbs::Goto* jumpOf(const gibbs::Statement& statement) {
  if (const auto* jump = std::get_if<gibbs::Goto>(&statement.node)) return jump;
  const auto* branch = std::get_if<gibbs::If>(&statement.node);
  return branch != nullptr && branch->then ? jumpOf(*branch->then) : nullptr;
}

bool asks(const gibbs::Line& line) {
  if (!line.statement) return false;
  const std::string name = commandName(*line.statement);
  return name == "DIALOG" || name == "INPUT" || name == "YESNO";
}

void checkMacro(const gibbs::Macro& macro, Report& report) {
  const auto& lines = macro.lines;
  const auto dialog =
      static_cast<std::size_t>(std::find_if(lines.begin(), lines.end(), asks) - lines.begin());
  if (dialog == lines.size() || macro.hasErrorNodes) return;
  std::map<std::string, std::size_t> labels;
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (lines[i].label) labels.emplace(gibbs::foldCase(lines[i].label->name.text), i);
  std::set<std::string> used;
  bool messages = false;
  eachStatement(macro, [&](const gibbs::Statement& statement) {
    if (const auto* jump = std::get_if<gibbs::Goto>(&statement.node))
      used.insert(gibbs::foldCase(jump->label.text));
    messages = messages || commandName(statement) == "MESSAGE";
  });
  // The label in front of the dialog is the path back. With other jumps in the macro label-never-used tells
  // it.
  if (dialog > 0 && lines[dialog - 1].label && used.empty() && messages) {
    report.at(lines[dialog - 1].label->name.range,
              "nothing jumps back to `{}` in front of the dialog; after a message the macro goes on with the "
              "values that it complained of; write the GOTO",
              lines[dialog - 1].label->name.text);
    return;
  }
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const gibbs::Goto* jump = lines[i].statement ? jumpOf(*lines[i].statement) : nullptr;
    const auto target = jump == nullptr ? labels.end() : labels.find(gibbs::foldCase(jump->label.text));
    if (target == labels.end() || target->second >= i || target->second <= dialog) continue;
    const bool again = std::any_of(lines.begin() + static_cast<std::ptrdiff_t>(target->second),
                                   lines.begin() + static_cast<std::ptrdiff_t>(i), asks);
    // A loop that counts is another matter: something in it changes.
    const bool changes =
        std::any_of(lines.begin() + static_cast<std::ptrdiff_t>(target->second),
                    lines.begin() + static_cast<std::ptrdiff_t>(i), [](const gibbs::Line& line) {
                      const auto* assign =
                          line.statement ? std::get_if<gibbs::Assignment>(&line.statement->node) : nullptr;
                      return assign != nullptr && assign->value && !plainNumber(*assign->value);
                    });
    if (again || changes) continue;
    report
        .at(jump->label.range, "this goes back after the dialog, not in front of it; the user cannot change "
                               "what was wrong, and the "
                               "macro comes here again for ever; put the label before DIALOG")
        .note(lines[target->second].label->name.range, "the label");
  }
}

void check(const Project& project, Report& report) {
  for (const gibbs::Macro* macro : project.allMacros())
    checkMacro(*macro, report);
}

} // namespace

DOTEK_LINT_RULE(dialog_not_shown_again){
    .severity = Severity::Warning,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
