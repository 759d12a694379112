#include "frontend/mikroprog/Motion.h"
#include "lint/SufPrograms.h"

#include <algorithm>

namespace dotek::lint::rule {
namespace {

void checkProgram(const mikroprog::Reading& reading, Report& report) {
  mikroprog::walkMotion(reading, [&](const mikroprog::Block& block, const mikroprog::MotionState& state) {
    const bool any = std::any_of(block.codes.begin(), block.codes.end(), [](const mikroprog::Code& code) {
      return code.function == nullptr || !code.function->addresses.empty();
    });
    if (any || block.line->assignment || !mikroprog::hasAxisWord(block, reading.control)) return;
    report.at(block.line->range, "{} is left out in this block; the control allows it{}",
              state.motion == "rapid"  ? "G0"
              : state.motion == "feed" ? "G1"
                                       : "the arc",
              state.motion.starts_with("arc-") ? " for G0 and G1 by the sources, not for arcs" : "");
  });
}

} // namespace

DOTEK_LINT_RULE(suf_short_form){
    .severity = Severity::Note,
    .byDefault = false,
    .check = checkSufPrograms<checkProgram>,
};

} // namespace dotek::lint::rule
