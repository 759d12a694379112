#include "lint/ProgBlocks.h"

#include <algorithm>
#include <iterator>

namespace dotek::lint::rule {
namespace {

using Body = std::vector<compost::Statement>;

// The statement that the range is in; nullptr: none of these.
const compost::Statement* holding(const Body& statements, SourceRange range) {
  const auto after = std::upper_bound(statements.begin(), statements.end(), range.begin,
                                      [](std::uint32_t begin, const compost::Statement& statement) {
                                        return begin < rangeOf(statement).begin;
                                      });
  if (after == statements.begin()) return nullptr;
  const SourceRange whole = rangeOf(*std::prev(after));
  return whole.file == range.file && range.end <= whole.end ? &*std::prev(after) : nullptr;
}

// The one is below an IF and the other below its ELSE: no line has both.
bool exclude(const Body& statements, SourceRange first, SourceRange second) {
  const compost::Statement* holder = holding(statements, first);
  if (holder == nullptr || holder != holding(statements, second)) return false;
  const auto* branch = std::get_if<std::unique_ptr<compost::If>>(holder);
  if (branch == nullptr) return false;
  const Body& then = (*branch)->thenBody;
  const Body& otherwise = (*branch)->elseBody;
  const bool below = holding(then, first) != nullptr;
  if (below && holding(otherwise, second) != nullptr) return true;
  return exclude(below ? then : otherwise, first, second);
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
