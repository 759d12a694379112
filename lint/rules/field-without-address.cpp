#include "lint/ProgBlocks.h"

#include <cctype>
#include <set>
#include <tuple>

namespace dotek::lint::rule {
namespace {

// What is printed before a piece: whether a comment is open, and the last character, blanks aside (0:
// nothing, or another value).
struct Before {
  bool comment = false;
  char last = '\0';

  void pass(const ProgPiece& piece) {
    if (piece.kind != ProgPiece::Kind::Text) {
      last = '\0';
      return;
    }
    for (const char c : piece.literal->text) {
      comment = c == '(' || (comment && c != ')');
      if (c != ' ' && c != '\t') last = c;
    }
  }
};

using Place = std::tuple<FileId, std::uint32_t, std::uint32_t>;
Place placeOf(SourceRange range) {
  return {range.file, range.begin, range.end};
}

void check(const Project& project, Report& report) {
  eachRoutine(project, [&](const compost::Program& prog, const compost::Routine& routine) {
    if (prog.hasErrorNodes || !routine.returnRange) return; // told already
    for (const ProgBlock* block : ownBlocks(routine, prog, project)) {
      const std::vector<ProgWord> words = wordsOf(*block, project.form);
      if (words.empty()) continue;
      std::set<Place> holes; // that an address takes
      for (const ProgWord& word : words)
        if (word.hole != nullptr) holes.insert(placeOf(word.hole->range));
      Before text;
      for (const ProgPiece& piece : block->pieces) {
        const auto [comment, last] = text;
        text.pass(piece);
        if (piece.field.empty() || comment || holes.contains(placeOf(piece.range))) continue;
        if (last == '-' || last == '+') continue;
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
