#include "frontend/gibbs/Walk.h"
#include "lint/MacroNames.h"

#include <cctype>

namespace dotek::lint::rule {
namespace {

// A folder that other machines do not have: a drive's folder of users, or a home folder.
bool isPersonal(const std::string& text) {
  const std::string folded = gibbs::foldCase(text);
  const bool drive = folded.size() > 2 && std::isalpha(static_cast<unsigned char>(folded[0])) != 0 &&
                     folded[1] == ':' && (folded[2] == '\\' || folded[2] == '/');
  const std::string_view rest = std::string_view(folded).substr(drive ? 3 : 0);
  return (drive && (rest.starts_with("USERS\\") || rest.starts_with("USERS/") ||
                    rest.starts_with("DOCUMENTS AND SETTINGS"))) ||
         folded.starts_with("/HOME/");
}

void check(const Project& project, Report& report) {
  for (const gibbs::Macro* macro : project.allMacros()) {
    eachStatement(*macro, [&](const gibbs::Statement& statement) {
      gibbs::ownExpressions(statement, [&](const gibbs::Expression& outer) {
        gibbs::walkExpression(outer, [&](const gibbs::Expression& each) {
          const auto* text = std::get_if<gibbs::TextLiteral>(&each.node);
          if (text != nullptr && isPersonal(text->text))
            report.at(each.range,
                      "the path leads into the folder of one user; on another machine, or for another "
                      "user, GibbsCAM does not find it; use a path that all have, or ask for it");
        });
      });
    });
  }
}

} // namespace

DOTEK_LINT_RULE(path_of_one_machine){
    .severity = Severity::Warning,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
