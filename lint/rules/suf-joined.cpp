#include "frontend/mikroprog/Motion.h"
#include "lint/SufPrograms.h"

namespace dotek::lint::rule {
namespace {

void checkProgram(const mikroprog::Reading& reading, Report& report) {
  mikroprog::walkMotion(reading, [&](const mikroprog::Block& block, const mikroprog::MotionState& state) {
    if (!state.joined) return;
    for (const std::string_view other :
         {"jump-if", "probe-move", "record-position", "record-value", "read-value"})
      if (block.does(other))
        report.at(block.line->range,
                  "M40 joins blocks here, so the control may decide or store before the move "
                  "before this block has ended; write M41 before");
  });
}

} // namespace

DOTEK_LINT_RULE(suf_joined){
    .severity = Severity::Warning,
    .check = checkSufPrograms<checkProgram>,
};

} // namespace dotek::lint::rule
