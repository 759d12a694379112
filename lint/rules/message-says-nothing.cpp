#include "lint/MacroNames.h"

namespace dotek::lint::rule {
namespace {

void check(const Project& project, Report& report) {
  for (const gibbs::Macro* macro : project.allMacros()) {
    eachStatement(*macro, [&](const gibbs::Statement& statement) {
      const auto* command = std::get_if<gibbs::Command>(&statement.node);
      if (command == nullptr || gibbs::foldCase(command->name.text) != "MESSAGE") return;
      bool empty = true;
      for (const gibbs::ExpressionPtr& argument : command->arguments) {
        const auto* text = std::get_if<gibbs::TextLiteral>(&argument->node);
        empty = empty && text != nullptr && text->text.find_first_not_of(" \t") == std::string::npos;
      }
      if (empty && !command->arguments.empty())
        report.at(statement.range,
                  "the message is empty; the user sees a window that does not say what is wrong; "
                  "write the reason and what to change");
    });
  }
}

} // namespace

DOTEK_LINT_RULE(message_says_nothing){
    .severity = Severity::Warning,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
