#include "lint/SufPrograms.h"

namespace dotek::lint::rule {
namespace {

void checkProgram(const mikroprog::Reading& reading, Report& report) {
  bool spindle = false, coolant = false;
  for (const mikroprog::Block& block : reading.blocks) {
    if (block.line->unread) continue;
    if (block.does("spindle-right") || block.does("spindle-left")) spindle = true;
    if (block.does("spindle-off")) spindle = false;
    if (block.does("coolant-on")) coolant = true;
    if (block.does("coolant-off")) coolant = false;
    if (!block.does("probe-move")) continue;
    if (spindle) report.at(block.line->range, "the spindle is on at this G31");
    if (coolant) report.at(block.line->range, "the coolant is on at this G31");
  }
}

} // namespace

DOTEK_LINT_RULE(suf_probe_turning){
    .severity = Severity::Warning,
    .check = checkSufPrograms<checkProgram>,
};

} // namespace dotek::lint::rule
