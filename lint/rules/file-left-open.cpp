#include "lint/MacroNames.h"

#include <map>

namespace dotek::lint::rule {
namespace {

void check(const Project& project, Report& report) {
  for (const gibbs::Macro* macro : project.allMacros()) {
    std::map<double, SourceRange> opened;
    std::set<double> closed;
    bool computed = false;
    bool calls = false;
    eachStatement(*macro, [&](const gibbs::Statement& statement) {
      calls = calls || std::holds_alternative<gibbs::CallMacro>(statement.node) ||
              std::holds_alternative<gibbs::Include>(statement.node);
      const auto* command = std::get_if<gibbs::Command>(&statement.node);
      if (command == nullptr) return;
      const std::string name = gibbs::foldCase(command->name.text);
      if (name != "FILE_OPEN" && name != "FILE_CLOSE") return;
      const auto unit = command->arguments.empty() ? std::nullopt : plainNumber(*command->arguments.front());
      if (!unit)
        computed = true;
      else if (name == "FILE_OPEN")
        opened.try_emplace(*unit, statement.range);
      else
        closed.insert(*unit);
    });
    if (computed || calls) continue;
    for (const auto& [unit, range] : opened)
      // A unit outside 1 to 10 opens no file.
      if (unit >= 1 && unit <= 10 && !closed.contains(unit))
        report.at(range,
                  "nothing closes this file; what was written last may be missing in it, and the unit stays "
                  "taken; write FILE_CLOSE {}",
                  static_cast<long>(unit));
  }
}

} // namespace

DOTEK_LINT_RULE(file_left_open){
    .severity = Severity::Warning,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
