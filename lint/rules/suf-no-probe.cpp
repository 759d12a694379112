#include "lint/SufPrograms.h"

namespace dotek::lint::rule {
namespace {

void checkProgram(const mikroprog::Reading& reading, Report& report) {
  if (reading.control.name != stdlib::kMikroprogLathe) return;
  for (const mikroprog::Block& block : reading.blocks) {
    if (block.line->unread || !block.does("probe-move")) continue;
    report.at(block.line->range, "a probe move on the lathe S280, to which no probe is fitted");
    return;
  }
}

} // namespace

DOTEK_LINT_RULE(suf_no_probe){
    .severity = Severity::Note,
    .byDefault = false,
    .check = checkSufPrograms<checkProgram>,
};

} // namespace dotek::lint::rule
