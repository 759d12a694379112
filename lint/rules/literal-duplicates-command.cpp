#include "lint/ProgBlocks.h"

#include <map>
#include <string_view>

namespace dotek::lint::rule {
namespace {

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(' ');
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(' ') + 1 - first);
}

// First use of each command in the Prog.
using Uses = std::map<std::string_view, const compost::Word*>;

Uses firstUses(const compost::Program& prog) {
  Uses out;
  for (const compost::Item& item : prog.items) {
    const auto* routine = std::get_if<compost::Routine>(&item);
    if (routine == nullptr) continue;
    eachStatement(routine->body, [&](const compost::Statement& statement) {
      const auto* word = std::get_if<compost::Word>(&statement);
      if (word != nullptr && word->kind == compost::WordKind::Command) out.try_emplace(word->name, word);
    });
  }
  return out;
}

void check(const Project& project, Report& report) {
  if (!project.form) return;
  const compost::Program* last = nullptr;
  Uses uses;
  eachRoutine(project, [&](const compost::Program& prog, const compost::Routine& routine) {
    if (last != &prog) uses = firstUses(prog);
    last = &prog;
    eachStatement(routine.body, [&](const compost::Statement& statement) {
      const auto* literal = std::get_if<compost::Literal>(&statement);
      if (literal == nullptr || trimmed(literal->text).empty()) return;
      for (const auto& [name, entry] : project.form->commands) {
        if (!entry.value.empty() || trimmed(entry.text) != trimmed(literal->text)) continue;
        const auto use = uses.find(name);
        if (use == uses.end()) continue;
        report
            .at(literal->range,
                "`{}` is what the command `{}` prints; after a literal the post does not know of it and may "
                "print it again, or leave out what undoes it; write `{}`",
                trimmed(literal->text), name, name)
            .note(use->second->range, "the command is used here");
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
