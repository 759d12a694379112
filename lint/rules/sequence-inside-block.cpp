#include "lint/ProgBlocks.h"

namespace dotek::lint::rule {
namespace {

void check(const Project& project, Report& report) {
  eachRoutine(project, [&](const compost::Program& prog, const compost::Routine& routine) {
    for (const ProgBlock& block : blocksOf(routine.body, prog, project)) {
      for (std::size_t i = 1; i < block.pieces.size(); ++i) {
        const ProgPiece& piece = block.pieces[i];
        const ProgPiece& before = block.pieces[i - 1];
        if (piece.kind != ProgPiece::Kind::Sequence || piece.arm != before.arm) continue;
        // A routine that is called begins a block; the caller left one open.
        const SourceRange inside = routine.range;
        const auto own = [&](SourceRange range) {
          return range.begin >= inside.begin && range.end <= inside.end;
        };
        if (!own(before.range)) continue;
        report
            .at(before.range, "the block is not ended behind this, and the next one begins with its number; "
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
    .explanation = "A block number is printed behind text of the same line: the EOL between the two is "
                   "missing.",
    .check = check,
};

} // namespace dotek::lint::rule
