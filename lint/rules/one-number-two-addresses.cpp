#include "lint/ProgBlocks.h"

namespace dotek::lint::rule {
namespace {

bool sameNumber(const ProgPiece& a, const ProgPiece& b) {
  if (a.kind != ProgPiece::Kind::Number || b.kind != ProgPiece::Kind::Number) return false;
  if (a.word->name != b.word->name || a.word->arguments.size() != b.word->arguments.size()) return false;
  for (std::size_t i = 0; i < a.word->arguments.size(); ++i)
    if (a.word->arguments[i].text != b.word->arguments[i].text) return false;
  return true;
}

void check(const Project& project, Report& report) {
  eachRoutine(project, [&](const compost::Program& prog, const compost::Routine& routine) {
    // Each arm of an IF prints a block of its own.
    const auto arm = [&](const std::vector<compost::Statement>& body, const auto& self) -> void {
      for (const compost::Statement& statement : body) {
        if (const auto* branch = std::get_if<std::unique_ptr<compost::If>>(&statement)) {
          self((*branch)->thenBody, self);
          self((*branch)->elseBody, self);
        }
      }
      for (const ProgBlock& block : blocksOf(body, prog, project)) {
        if (block.called || block.conditional) continue;
        const std::vector<ProgWord> words = wordsOf(block, nullptr);
        for (std::size_t i = 0; i < words.size(); ++i) {
          for (std::size_t j = 0; j < i; ++j) {
            if (words[i].hole == nullptr || words[j].hole == nullptr || words[i].digits != words[j].digits)
              continue;
            if (words[i].address == words[j].address || !sameNumber(*words[i].hole, *words[j].hole)) continue;
            report
                .at(words[i].hole->range,
                    "`{}` is printed after `{}` and after `{}`; the two are always the same number on the "
                    "machine",
                    words[i].hole->word->name + "#", words[j].address, words[i].address)
                .note(words[j].hole->range, "printed here, too");
          }
        }
      }
    };
    arm(routine.body, arm);
  });
}

} // namespace

DOTEK_LINT_RULE(one_number_two_addresses){
    .severity = Severity::Note,
    .byDefault = false,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
