#include "lint/ProgBlocks.h"

namespace dotek::lint::rule {
namespace {

void check(const Project& project, Report& report) {
  eachRoutine(project, [&](const compost::Program& prog, const compost::Routine& routine) {
    std::vector<SourceRange> without;
    bool others = false;
    for (const ProgBlock& block : blocksOf(routine.body, prog, project)) {
      const std::vector<ProgWord> words = wordsOf(block, project.form);
      const MacroMeaning meaning = meaningOf(project, macroCalled(words));
      if (meaning.set == nullptr || meaning.intent != stdlib::Intent::ProtectedMove) continue;
      if (findWord(words, 'F') != nullptr)
        others = true;
      else if (!block.called && !printsUnknown(block, project.form))
        without.push_back(block.range);
    }
    if (!others) return;
    for (const SourceRange range : without)
      report.at(range,
                "this protected move states no feed, others of the routine do; the machine takes the last "
                "feed that was used, whatever it was; write F");
  });
}

} // namespace

DOTEK_LINT_RULE(protected_move_without_feed){
    .severity = Severity::Note,
    .byDefault = false,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
