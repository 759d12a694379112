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

void check(const Project& project, Report& report) {
  for (const mikroprog::Reading* reading : project.sufPrograms)
    checkProgram(*reading, report);
}

} // namespace

DOTEK_LINT_RULE(suf_no_probe){
    .severity = Severity::Note,
    .byDefault = false,
    .check = check,
};

} // namespace dotek::lint::rule
