#include "lint/ProgBlocks.h"

#include <algorithm>

namespace dotek::lint::rule {
namespace {

bool holds(const std::vector<compost::Statement>& statements, SourceRange range) {
  return std::any_of(statements.begin(), statements.end(), [&](const compost::Statement& statement) {
    const SourceRange whole = rangeOf(statement);
    return whole.file == range.file && whole.begin <= range.begin && range.end <= whole.end;
  });
}

// The one is below an IF and the other below its ELSE: no line has both.
bool exclude(const std::vector<compost::Statement>& statements, SourceRange first, SourceRange second) {
  bool found = false;
  eachStatement(statements, [&](const compost::Statement& statement) {
    const auto* branch = std::get_if<std::unique_ptr<compost::If>>(&statement);
    found = found ||
            (branch != nullptr && holds((*branch)->thenBody, first) && holds((*branch)->elseBody, second));
  });
  return found;
}

void check(const Project& project, Report& report) {
  eachRoutine(project, [&](const compost::Program& prog, const compost::Routine& routine) {
    if (prog.hasErrorNodes || !routine.returnRange) return; // told already
    for (const ProgBlock& block : blocksOf(routine.body, prog, project)) {
      for (std::size_t i = 1; i < block.pieces.size(); ++i) {
        const ProgPiece& piece = block.pieces[i];
        const ProgPiece& before = block.pieces[i - 1];
        if (piece.kind != ProgPiece::Kind::Sequence || exclude(routine.body, before.range, piece.range))
          continue;
        // A routine that is called begins a block; the caller left one open.
        const SourceRange inside = routine.range;
        const auto own = [&](SourceRange range) {
          return range.begin >= inside.begin && range.end <= inside.end;
        };
        if (!own(before.range)) continue;
        report
            .at(before.range, "the block is not ended after this, and the next one begins with its number; "
                              "both come out as "
                              "one line, which the control refuses or reads as one block; write EOL")
            .note(piece.range, "the number of the next block");
      }
    }
  });
}

} // namespace

DOTEK_LINT_RULE(sequence_inside_block){
    .severity = Severity::Warning,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
