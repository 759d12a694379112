#include "frontend/mikroprog/Motion.h"
#include "lint/SufPrograms.h"

namespace dotek::lint::rule {
namespace {

void checkProgram(const mikroprog::Reading& reading, Report& report) {
  // After a contact the probe leaves the part in feed, and the spindle rests.
  for (const mikroprog::Block& block : reading.blocks)
    if (block.does("probe-move")) return;
  bool told = false; // since the spindle last turned
  mikroprog::walkMotion(reading, [&](const mikroprog::Block& block, const mikroprog::MotionState& state) {
    if (state.turning.value_or(true)) told = false;
    if (told || state.turning.value_or(true) || !mikroprog::isCut(block, state, reading.control)) return;
    told = true;
    report.at(block.line->range, "a feed move while the spindle rests{}; write M3 or M4 with S before it",
              state.perRevolution.value_or(false) ? ", and under G95 the tool does not move then" : "");
  });
}

} // namespace

DOTEK_LINT_RULE(suf_spindle_stopped){
    .severity = Severity::Warning,
    .check = checkSufPrograms<checkProgram>,
};

} // namespace dotek::lint::rule
