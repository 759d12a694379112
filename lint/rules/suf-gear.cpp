#include "lint/SufPrograms.h"

namespace dotek::lint::rule {
namespace {

void checkProgram(const mikroprog::Reading& reading, Report& report) {
  const mikroprog::Block* last = nullptr; // M40 or M41 in the block before
  for (const mikroprog::Block& block : reading.blocks) {
    if (block.line->words.empty()) continue;
    const bool joins = block.does("join-on") || block.does("join-off");
    const bool turns = block.does("spindle-right") || block.does("spindle-left");
    const mikroprog::Block* const found = turns && joins ? &block : turns ? last : nullptr;
    if (found != nullptr)
      report.at(found->line->range,
                "M40 and M41 join blocks and end that here; other controls change a gear of the "
                "spindle by them, and the spindle starts right after");
    last = joins ? &block : nullptr;
  }
}

} // namespace

DOTEK_LINT_RULE(suf_gear){
    .severity = Severity::Warning,
    .check = checkSufPrograms<checkProgram>,
};

} // namespace dotek::lint::rule
