#include "lint/ProgBlocks.h"

namespace dotek::lint::rule {
namespace {

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(' ');
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(' ') + 1 - first);
}

// First use of the command in the Prog; nullptr: it is never used.
const compost::Word* firstUse(const compost::Program& prog, std::string_view name) {
  const compost::Word* found = nullptr;
  for (const compost::Item& item : prog.items) {
    const auto* routine = std::get_if<compost::Routine>(&item);
    if (routine == nullptr) continue;
    eachStatement(routine->body, [&](const compost::Statement& statement) {
      const auto* word = std::get_if<compost::Word>(&statement);
      if (found == nullptr && word != nullptr && word->kind == compost::WordKind::Command &&
          word->name == name)
        found = word;
    });
  }
  return found;
}

void check(const Project& project, Report& report) {
  if (!project.form) return;
  eachRoutine(project, [&](const compost::Program& prog, const compost::Routine& routine) {
    eachStatement(routine.body, [&](const compost::Statement& statement) {
      const auto* literal = std::get_if<compost::Literal>(&statement);
      if (literal == nullptr || trimmed(literal->text).empty()) return;
      for (const auto& [name, entry] : project.form->commands) {
        if (!entry.value.empty() || trimmed(entry.text) != trimmed(literal->text)) continue;
        const compost::Word* use = firstUse(prog, name);
        if (use == nullptr) continue;
        report
            .at(literal->range,
                "`{}` is what the command `{}` prints; after a literal the post does not know of it and may "
                "print it again, or leave out what undoes it; write `{}`",
                trimmed(literal->text), name, name)
            .note(use->range, "the command is used here");
        return;
      }
    });
  });
}

} // namespace

DOTEK_LINT_RULE(literal_duplicates_command){
    .severity = Severity::Warning,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
