#include "lint/SufPrograms.h"

namespace dotek::lint::rule {
namespace {

void check(const Project& project, Report& report) {
  forEachSufBlock(project, [&](const mikroprog::Reading&, const mikroprog::Block& block) {
    if (block.does("leave"))
      report.at(block.line->range,
                "M99 ends the program and leaves the CNC mode for the editor; the return of "
                "a subprogram is M17");
  });
}

} // namespace

DOTEK_LINT_RULE(suf_leaves_mode){
    .severity = Severity::Warning,
    .check = check,
};

} // namespace dotek::lint::rule
