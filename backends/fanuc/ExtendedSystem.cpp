// Work systems beyond G59 in copied blocks: G54.1 P1 of one control is G154 P1 of another (haas.md, 7).
#include "backends/fanuc/State.h"
#include "support/Decimal.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace dotek::backends::fanuc {

namespace {

const ir::Word* find(const ir::OpaqueBlock& block, char address) {
  const auto at = std::find_if(block.words.begin(), block.words.end(),
                               [&](const ir::Word& word) { return word.address == address; });
  return at == block.words.end() ? nullptr : &*at;
}

bool isCode(const ir::Word& word, const stdlib::CodeInfo& code) {
  const double* number = word.value == nullptr ? nullptr : ir::constantValue(word.value);
  return number != nullptr && word.address == code.letter &&
         std::round(*number * 10) == static_cast<double>(code.tenths);
}

} // namespace

void translateExtendedSystem(State& state) {
  const stdlib::Control& from = state.options.sourceControl;
  const stdlib::CodeInfo* const here = from.find(stdlib::Function::ExtendedWorkSystem);
  const stdlib::CodeInfo* const there = state.control.find(stdlib::Function::ExtendedWorkSystem);
  if (here == nullptr || there == nullptr) return;
  if (here->letter == there->letter && here->tenths == there->tenths) return;
  // Both have at least those whose offsets variables hold.
  const int most = std::min(from.variables.extendedCount, state.control.variables.extendedCount);
  std::vector<ir::Word*> found;
  for (auto* list : {&state.cycle.checks, &state.cycle.body})
    for (ir::CycleStatement& statement : *list) {
      auto* const block = std::get_if<ir::OpaqueBlock>(&statement.node);
      if (block == nullptr) continue;
      for (ir::Word& word : block->words) {
        if (isCode(word, *there)) return; // the source has it for something else
        const ir::Word* const which = find(*block, 'P');
        if (!isCode(word, *here) || which == nullptr || which->value == nullptr) continue;
        const double* const number = ir::constantValue(which->value);
        if (number != nullptr ? *number >= 1 && *number <= most : confinedTo(state, which->value, 1, most))
          found.push_back(&word);
      }
    }
  for (ir::Word* const word : found)
    word->value = ir::constant(there->tenths / 10.0, word->value->range, numberText(there->tenths / 10.0));
  state.extendedTranslated = !found.empty();
}

} // namespace dotek::backends::fanuc
