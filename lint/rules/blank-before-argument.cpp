#include "lint/ProgBlocks.h"

namespace dotek::lint::rule {
namespace {

void checkWord(const compost::Word& word, const Project& project, Report& report) {
  if (word.arguments.empty()) return;
  const SourceRange between{word.range.file, word.nameRange.end, word.arguments.front().range.begin};
  const std::size_t open = project.sources.text(between).find('(');
  if (open == 0 || open == std::string_view::npos) return;
  const SourceRange blanks{word.range.file, word.nameRange.end,
                           word.nameRange.end + static_cast<std::uint32_t>(open)};
  if (project.sources.text(blanks).find_first_not_of(" \t") != std::string_view::npos) return;
  report
      .at(blanks, "a blank is between `{}` and its bracket; the compiler takes it; write them together",
          project.sources.textUtf8(word.nameRange))
      .fix = Fix{Fix::Applicability::Safe, "take the blank out", {{blanks, ""}}};
}

void checkCondition(const compost::Condition& condition, const Project& project, Report& report) {
  for (const compost::ConditionTerm& term : condition.terms) {
    if (const auto* word = std::get_if<compost::Word>(&term.operand)) checkWord(*word, project, report);
    if (const auto* inner = std::get_if<std::unique_ptr<compost::Condition>>(&term.operand))
      checkCondition(**inner, project, report);
  }
}

void check(const Project& project, Report& report) {
  eachRoutine(project, [&](const compost::Program&, const compost::Routine& routine) {
    eachStatement(routine.body, [&](const compost::Statement& statement) {
      if (const auto* word = std::get_if<compost::Word>(&statement)) checkWord(*word, project, report);
      if (const auto* branch = std::get_if<std::unique_ptr<compost::If>>(&statement))
        checkCondition((*branch)->condition, project, report);
    });
  });
}

} // namespace

DOTEK_LINT_RULE(blank_before_argument){
    .severity = Severity::Note,
    .byDefault = false,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
