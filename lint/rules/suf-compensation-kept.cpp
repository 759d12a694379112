#include "frontend/mikroprog/Motion.h"
#include "lint/SufPrograms.h"

namespace dotek::lint::rule {
namespace {

void checkProgram(const mikroprog::Reading& reading, Report& report) {
  mikroprog::walkMotion(reading, [&](const mikroprog::Block& block, const mikroprog::MotionState& state) {
    if (state.compensated && block.does("end"))
      report.at(block.line->range,
                "G41 or G42 is in force at the end of the program; the control ends it, and the "
                "way back was compensated: write G40 where the contour ends");
  });
}

} // namespace

DOTEK_LINT_RULE(suf_compensation_kept){
    .severity = Severity::Note,
    .check = checkSufPrograms<checkProgram>,
};

} // namespace dotek::lint::rule
