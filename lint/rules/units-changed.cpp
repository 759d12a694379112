#include "lint/NcProgram.h"
#include "lint/Skips.h"

#include <algorithm>

namespace dotek::lint::rule {
namespace {

bool isComputed(const ir::Word& word) {
  return word.address == 'G' && ir::constantValue(word.value) == nullptr;
}

// In the order of the text. A program that takes the units from a variable knows what it does.
void check(const NcProgram& nc, Report& report) {
  const ir::Word *first = nullptr, *second = nullptr;
  bool moved = false;
  for (const ir::ProgramStatement& statement : nc.program.body) {
    const auto* block = std::get_if<ir::NcBlock>(&statement.node);
    if (block == nullptr) continue;
    if (std::any_of(block->words.begin(), block->words.end(), isComputed)) return;
    const ir::Word* units = codeWord(*block, 'G', 20);
    if (units == nullptr) units = codeWord(*block, 'G', 21);
    if (units != nullptr) {
      if (first == nullptr) {
        first = units;
      } else if (*ir::constantValue(units->value) != *ir::constantValue(first->value)) {
        if (second == nullptr && moved) second = units;
      } else {
        second = nullptr;
      }
    }
    const bool moves = isPlainMove(*block) && firstWord(*block, "XYZUVW") != nullptr;
    if (first != nullptr && second == nullptr) moved = moved || moves;
    if (second == nullptr || !moves) continue;
    report
        .at(second->range,
            "the units change after the program has moved in the others; manuals allow it at the begin of a "
            "program alone, and offsets and positions are then of the other unit; write one of the codes, at "
            "the begin")
        .note(first->range, "the other units are chosen here");
    return;
  }
}

} // namespace

DOTEK_LINT_RULE(units_changed){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
