#include "lint/ProgBlocks.h"

#include <iterator>
#include <map>
#include <optional>
#include <utility>

namespace dotek::lint::rule {
namespace {

// The pieces of a block by their place, the first at each.
class Arms {
public:
  explicit Arms(const ProgBlock& block) {
    for (const ProgPiece& piece : block.pieces)
      pieces_.try_emplace({piece.range.file, piece.range.begin}, &piece);
  }
  // The part of an IF below which the text of a word is; nothing: not found.
  std::optional<std::uint32_t> of(const ProgWord& word) const {
    const auto after = pieces_.upper_bound({word.range.file, word.range.begin});
    if (after == pieces_.begin()) return std::nullopt;
    const ProgPiece& piece = *std::prev(after)->second;
    const bool within = word.range.file == piece.range.file && word.range.end <= piece.range.end;
    return within ? std::optional(piece.arm) : std::nullopt;
  }

private:
  std::map<std::pair<FileId, std::uint32_t>, const ProgPiece*> pieces_;
};

void check(const Project& project, Report& report) {
  eachRoutine(project, [&](const compost::Program& prog, const compost::Routine& routine) {
    if (prog.hasErrorNodes || !routine.returnRange) return; // told already
    for (const ProgBlock* block : ownBlocks(routine, prog, project)) {
      const std::vector<ProgWord> words = wordsOf(*block, project.form);
      const bool call = macroCalled(words) != 0;
      const Arms arms(*block);
      std::map<std::pair<char, std::optional<std::uint32_t>>, const ProgWord*> printed; // the first of each
      for (const ProgWord& word : words) {
        const char address = word.address;
        const auto [first, added] = printed.try_emplace({address, arms.of(word)}, &word);
        // Several G and M are usual; I, J and K come in sets.
        if (added || address == 'G' || address == 'M' ||
            (call && address >= 'I' && address <= 'K' && word.hole == nullptr))
          continue;
        report
            .at(word.range,
                "the block prints `{0}` twice; the control takes one of the two values or stops with an "
                "alarm, "
                "and the address that was meant is missing; write it",
                address)
            .note(first->second->range, "printed here, too");
      }
    }
  });
}

} // namespace

DOTEK_LINT_RULE(address_printed_twice){
    .severity = Severity::Warning,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
