#include "lint/ProgBlocks.h"

namespace dotek::lint::rule {
namespace {

// The part of an IF below which the text of a word is; nothing: not found.
std::optional<std::uint32_t> armOf(const ProgBlock& block, const ProgWord& word) {
  for (const ProgPiece& piece : block.pieces)
    if (word.range.file == piece.range.file && word.range.begin >= piece.range.begin &&
        word.range.end <= piece.range.end)
      return piece.arm;
  return std::nullopt;
}

void check(const Project& project, Report& report) {
  eachRoutine(project, [&](const compost::Program& prog, const compost::Routine& routine) {
    if (prog.hasErrorNodes || !routine.returnRange) return; // told already
    for (const ProgBlock& block : blocksOf(routine.body, prog, project)) {
      if (block.called) continue;
      const std::vector<ProgWord> words = wordsOf(block, project.form);
      for (std::size_t i = 1; i < words.size(); ++i) {
        const char address = words[i].address;
        // Several G and M are usual; I, J and K come in sets.
        if (address == 'G' || address == 'M' ||
            (macroCalled(words) != 0 && address >= 'I' && address <= 'K' && words[i].hole == nullptr))
          continue;
        for (std::size_t k = 0; k < i; ++k) {
          if (words[k].address != address || armOf(block, words[k]) != armOf(block, words[i])) continue;
          report
              .at(words[i].range,
                  "the block prints `{0}` twice; the control takes one of the two values or stops with an "
                  "alarm, "
                  "and the address that was meant is missing; write it",
                  address)
              .note(words[k].range, "printed here, too");
          break;
        }
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
