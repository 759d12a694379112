#include "lint/SufPrograms.h"

namespace dotek::lint::rule {
namespace {

void checkProgram(const mikroprog::Reading& reading, Report& report) {
  for (const mikroprog::Block& block : reading.blocks) {
    if (block.line->unread) continue;
    if (block.does("jump-if") && mikroprog::wholeOf(block.line->find('O')) == mikroprog::kTouchProbe) return;
    if (!block.does("probe-move")) continue;
    report.at(block.line->range, "no `G23 L.. O7` before this G31; if the probe is in contact already, what "
                                 "the control does is not known (Q19)");
    return;
  }
}

} // namespace

DOTEK_LINT_RULE(suf_probe_no_guard){
    .severity = Severity::Warning,
    .check = checkSufPrograms<checkProgram>,
};

} // namespace dotek::lint::rule
