#include "lint/ProgBlocks.h"

#include <algorithm>
#include <cctype>

namespace dotek::lint::rule {
namespace {

// The last character that is printed before the piece, blanks aside; 0: nothing, or another value.
char before(const ProgBlock& block, std::size_t at) {
  for (std::size_t i = at; i-- > 0;) {
    const ProgPiece& piece = block.pieces[i];
    if (piece.kind != ProgPiece::Kind::Text) return '\0';
    const std::size_t last = piece.literal->text.find_last_not_of(" \t");
    if (last != std::string::npos) return piece.literal->text[last];
  }
  return '\0';
}

bool insideComment(const ProgBlock& block, std::size_t at) {
  bool comment = false;
  for (std::size_t i = 0; i < at; ++i)
    if (block.pieces[i].kind == ProgPiece::Kind::Text)
      for (const char c : block.pieces[i].literal->text)
        comment = c == '(' || (comment && c != ')');
  return comment;
}

void check(const Project& project, Report& report) {
  eachRoutine(project, [&](const compost::Program& prog, const compost::Routine& routine) {
    if (prog.hasErrorNodes || !routine.returnRange) return; // told already
    for (const ProgBlock& block : blocksOf(routine.body, prog, project)) {
      if (block.called) continue;
      const std::vector<ProgWord> words = wordsOf(block, project.form);
      if (words.empty()) continue;
      for (std::size_t i = 0; i < block.pieces.size(); ++i) {
        const ProgPiece& piece = block.pieces[i];
        if (piece.field.empty() || insideComment(block, i)) continue;
        const bool taken = std::any_of(words.begin(), words.end(), [&](const ProgWord& word) {
          return word.hole != nullptr && word.hole->range == piece.range;
        });
        const char last = before(block, i);
        if (taken || last == '-' || last == '+') continue;
        if (std::isalpha(static_cast<unsigned char>(last)) != 0) continue;
        report.at(
            piece.range,
            "no address is before `{}`; the block gets a number without a letter, and the control stops "
            "with an alarm; write the letter",
            piece.field);
      }
    }
  });
}

} // namespace

DOTEK_LINT_RULE(field_without_address){
    .severity = Severity::Warning,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
