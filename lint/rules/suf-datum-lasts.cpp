#include "lint/SufPrograms.h"

namespace dotek::lint::rule {
namespace {

// A G92 that no G98 follows.
void checkProgram(const mikroprog::Reading& reading, Report& report) {
  bool back = false;
  for (auto block = reading.blocks.rbegin(); block != reading.blocks.rend(); ++block) {
    if (block->line->unread) continue;
    back = back || block->does("reference");
    if (block->does("set-position") && !back)
      report.at(block->line->range, "G92 loses the old coordinate system; only G98 brings it back");
  }
}

} // namespace

DOTEK_LINT_RULE(suf_datum_lasts){
    .severity = Severity::Note,
    .check = checkSufPrograms<checkProgram>,
};

} // namespace dotek::lint::rule
