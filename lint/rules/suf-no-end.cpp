#include "lint/SufPrograms.h"

namespace dotek::lint::rule {
namespace {

void check(const Project& project, Report& report) {
  for (const mikroprog::Reading* reading : project.sufPrograms)
    if (!reading->end && !reading->blocks.empty())
      report.at({reading->program.file, 0, 1},
                "the program has no M30; spindle and coolant are not stopped at its end");
}

} // namespace

DOTEK_LINT_RULE(suf_no_end){
    .severity = Severity::Warning,
    .check = check,
};

} // namespace dotek::lint::rule
