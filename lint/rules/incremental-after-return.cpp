#include "ir/Flow.h"
#include "lint/NcProgram.h"
#include "lint/Skips.h"
#include "lint/Turning.h"

#include <algorithm>
#include <set>

namespace dotek::lint::rule {
namespace {

bool movesSomewhere(const ir::NcBlock& block) {
  return std::any_of(block.words.begin(), block.words.end(), [](const ir::Word& word) {
    const double* value = ir::constantValue(word.value);
    return word.address >= 'X' && word.address <= 'Z' && value != nullptr && *value != 0;
  });
}

bool hasCodes(const ir::NcBlock& block) {
  return firstWord(block, "G") != nullptr;
}

void check(const NcProgram& nc, Report& report) {
  if (isForLathe(nc.project)) return; // G91 is none of its codes
  std::set<ir::LabelId> targets;
  bool computed = false;
  for (const ir::ProgramStatement& statement : nc.program.body) {
    if (const auto target = ir::targetOf(statement)) targets.insert(*target);
    computed = computed || ir::isComputedJump(statement);
  }
  const ir::Word* since = nullptr; // G91 of a reference return
  bool absolute = false, moved = false;
  for (const ir::ProgramStatement& statement : nc.program.body) {
    const auto* label = std::get_if<ir::Label>(&statement.node);
    if (callOf(statement) != nullptr || (label != nullptr && (computed || targets.contains(label->label))))
      since = nullptr;
    const auto* block = std::get_if<ir::NcBlock>(&statement.node);
    if (ir::endsProgram(statement) || std::holds_alternative<ir::Exit>(statement.node)) {
      since = nullptr; // what follows is called
      continue;
    }
    if (block == nullptr) continue;
    const bool returns = hasCode(*block, 'G', 28) || hasCode(*block, 'G', 30);
    if (hasCode(*block, 'G', 90)) {
      since = nullptr;
      absolute = true;
    }
    if (const ir::Word* code = codeWord(*block, 'G', 91)) {
      since = returns ? code : nullptr;
      if (!returns) absolute = false;
    }
    if (returns || statement.blockDelete != 0) continue;
    const bool plain = isPlainMove(*block);
    if (plain && absolute && since == nullptr) moved = moved || movesSomewhere(*block);
    if (since == nullptr || !moved || !plain || !movesSomewhere(*block)) {
      if (since != nullptr && !plain && hasCodes(*block) && movesSomewhere(*block)) since = nullptr;
      continue;
    }
    report
        .at(statement.origin.range(),
            "G91 of the reference return is still in force, so this block goes by a distance, and the "
            "program "
            "has written coordinates before; the tool goes elsewhere; write G90 after the return")
        .note(since->range, "G91 is here");
    return;
  }
}

} // namespace

DOTEK_LINT_RULE(incremental_after_return){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
