#include "lint/MacroNames.h"
#include "stdlib/GibbsKeywords.h"

#include <algorithm>

namespace dotek::lint::rule {
namespace {

void check(const Project& project, Report& report) {
  for (const gibbs::Macro* macro : project.allMacros()) {
    bool others = false;
    std::set<std::string> ran; // commands anywhere in the file before the place
    std::set<std::string> told;
    std::set<std::string> all;
    eachStatement(*macro, [&](const gibbs::Statement& statement) {
      others = others || std::holds_alternative<gibbs::CallMacro>(statement.node) ||
               std::holds_alternative<gibbs::Include>(statement.node) ||
               std::holds_alternative<gibbs::Goto>(statement.node) ||
               std::holds_alternative<gibbs::Args>(statement.node);
      all.insert(commandName(statement));
    });
    // With jumps and callers the order of the text is not the order of the run.
    if (others) continue;
    std::vector<std::pair<std::uint32_t, std::string>> commands;
    eachStatement(*macro, [&](const gibbs::Statement& statement) {
      commands.emplace_back(statement.range.begin, commandName(statement));
    });
    for (const NameUse& use : namesOf(*macro, project)) {
      const stdlib::CursorNames* cursor = use.reads ? project.gibbsKeywords.cursor(use.key) : nullptr;
      if (cursor == nullptr) continue;
      const bool before = std::any_of(commands.begin(), commands.end(), [&](const auto& command) {
        return command.first < use.name->range.begin &&
               std::find(cursor->snapshot.begin(), cursor->snapshot.end(), command.second) !=
                   cursor->snapshot.end();
      });
      // A macro that never takes the list may be called by one that did.
      const bool later = std::any_of(cursor->snapshot.begin(), cursor->snapshot.end(),
                                     [&](const std::string& command) { return all.contains(command); });
      if (before || !later || !told.insert(use.key).second) continue;
      report.at(use.name->range,
                "`{}` is read before {} takes the list; what it gives then is not known; move the "
                "command up",
                use.name->text, cursor->snapshot.front());
    }
  }
}

} // namespace

DOTEK_LINT_RULE(list_read_before_get){
    .severity = Severity::Warning,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
