#include "lint/SufPrograms.h"

namespace dotek::lint::rule {
namespace {

void check(const Project& project, Report& report) {
  forEachSufBlock(project, [&](const mikroprog::Reading&, const mikroprog::Block& block) {
    if (block.does("probe-move") && block.line->find('L') == nullptr)
      report.at(block.line->range, "G31 without L: a path without contact ends in a fault message");
  });
}

} // namespace

DOTEK_LINT_RULE(suf_probe_no_target){
    .severity = Severity::Warning,
    .check = check,
};

} // namespace dotek::lint::rule
