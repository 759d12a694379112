#include "frontend/mikroprog/Motion.h"
#include "lint/SufPrograms.h"

namespace dotek::lint::rule {
namespace {

void checkProgram(const mikroprog::Reading& reading, Report& report) {
  if (!reading.control.hasAxis('Y')) return;
  const mikroprog::Block* down = nullptr; // the move before, where it went down
  mikroprog::walkMotion(reading, [&](const mikroprog::Block& block, const mikroprog::MotionState& state) {
    if (block.does("probe-move")) {
      if (down != nullptr)
        report.at(down->line->range,
                  "the probe goes down without protection before the G31 that follows; write G31 "
                  "with an L that goes on, and a jump for contact after it");
      down = nullptr;
      return;
    }
    if (!mikroprog::hasAxisWord(block, reading.control)) return;
    const mikroprog::Word* const z = block.line->find('Z');
    const auto way = state.travel(*block.line, 'Z', reading.control);
    const bool lower = z != nullptr && mikroprog::onlyMoves(block) &&
                       (way ? *way < 0 : z->value.number.value_or(0) < 0 && state.absolute.value_or(false));
    down = lower && !state.turning.value_or(false) ? &block : nullptr;
  });
}

} // namespace

DOTEK_LINT_RULE(suf_probe_approach){
    .severity = Severity::Warning,
    .check = checkSufPrograms<checkProgram>,
};

} // namespace dotek::lint::rule
