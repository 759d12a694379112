#include "lint/ProgBlocks.h"

#include <cctype>

namespace dotek::lint::rule {
namespace {

void check(const Project& project, Report& report) {
  eachRoutine(project, [&](const compost::Program& prog, const compost::Routine& routine) {
    if (prog.hasErrorNodes || !routine.returnRange) return; // told already
    for (const ProgBlock& block : blocksOf(routine.body, prog, project)) {
      if (block.called) continue;
      for (std::size_t i = 1; i < block.pieces.size(); ++i) {
        const ProgPiece& value = block.pieces[i];
        const ProgPiece& text = block.pieces[i - 1];
        if (value.kind != ProgPiece::Kind::Number || text.kind != ProgPiece::Kind::Text) continue;
        const std::string& before = text.literal->text;
        if (before.size() < 2 || (before.back() != '-' && before.back() != '+')) continue;
        if (std::isalpha(static_cast<unsigned char>(before[before.size() - 2])) == 0) continue;
        report
            .at(value.range,
                "the text before this value ends in `{}`, and a negative value prints its own sign; `{}--5.` "
                "is "
                "no number, and the control stops with an alarm; turn the sign in the macro, or take it out",
                before.substr(before.size() - 2), before[before.size() - 2])
            .note(text.range, "the sign");
      }
    }
  });
}

} // namespace

DOTEK_LINT_RULE(sign_before_field){
    .severity = Severity::Warning,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
