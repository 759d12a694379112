#include "lint/ProgBlocks.h"

#include <set>

namespace dotek::lint::rule {
namespace {

void collect(const compost::Condition& condition, std::set<std::string>& read) {
  for (const compost::ConditionTerm& term : condition.terms) {
    if (const auto* word = std::get_if<compost::Word>(&term.operand))
      if (word->name == "Flag" && word->arguments.size() == 1) read.insert(word->arguments.front().text);
    if (const auto* inner = std::get_if<std::unique_ptr<compost::Condition>>(&term.operand))
      collect(**inner, read);
  }
}

void check(const Project& project, Report& report) {
  for (const compost::Program* prog : project.progs) {
    std::set<std::string> read;
    std::vector<const compost::Literal*> set;
    for (const compost::Item& item : prog->items) {
      const auto* routine = std::get_if<compost::Routine>(&item);
      if (routine == nullptr) continue;
      eachStatement(routine->body, [&](const compost::Statement& statement) {
        if (const auto* branch = std::get_if<std::unique_ptr<compost::If>>(&statement))
          collect((*branch)->condition, read);
        const auto* word = std::get_if<compost::Word>(&statement);
        if (word != nullptr && (word->name == "SetFlag" || word->name == "SetFlagF") &&
            word->arguments.size() == 1)
          set.push_back(&word->arguments.front());
      });
    }
    // A part of a post sets flags for the rest of it.
    if (read.empty()) continue;
    std::set<std::string> told;
    for (const compost::Literal* name : set)
      if (!read.contains(name->text) && told.insert(name->text).second)
        report.at(name->range,
                  "no condition of this Prog reads the flag `{}`; setting it has no effect here; a macro may "
                  "read it, or the name is a misprint",
                  name->text);
  }
}

} // namespace

DOTEK_LINT_RULE(flag_never_read){
    .severity = Severity::Note,
    .byDefault = false,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
