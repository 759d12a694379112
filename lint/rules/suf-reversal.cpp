#include "frontend/mikroprog/Motion.h"
#include "lint/SufPrograms.h"

namespace dotek::lint::rule {
namespace {

void checkProgram(const mikroprog::Reading& reading, Report& report) {
  char told = 0; // direction that is reported
  mikroprog::walkMotion(reading, [&](const mikroprog::Block& block, const mikroprog::MotionState& state) {
    if (!state.reversed || !mikroprog::isCut(block, state, reading.control)) return;
    if (told == state.direction) return;
    told = state.direction;
    report.at(block.line->range,
              "the spindle has turned round and is not up to speed at this cut; write `G4 E5` after M{}",
              state.direction);
  });
}

} // namespace

DOTEK_LINT_RULE(suf_reversal){
    .severity = Severity::Warning,
    .check = checkSufPrograms<checkProgram>,
};

} // namespace dotek::lint::rule
