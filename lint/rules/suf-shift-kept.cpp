#include "frontend/mikroprog/Motion.h"
#include "lint/SufPrograms.h"

#include "stdlib/MikroprogControl.h"

namespace dotek::lint::rule {
namespace {

void checkProgram(const mikroprog::Reading& reading, Report& report) {
  const stdlib::MikroprogFunction* told = nullptr;
  mikroprog::walkMotion(reading, [&](const mikroprog::Block& block, const mikroprog::MotionState& state) {
    if (block.does("system-off")) told = nullptr;
    if (state.shift == nullptr || told == state.shift) return;
    for (const std::string_view other : {"set-position", "reference", "tool-change"}) {
      if (!block.does(other)) continue;
      told = state.shift;
      report.at(block.line->range, "`{}` is in force here{}; write G50 before", state.shift->code(),
                other == "set-position" ? ", and what G92 does to it is not known (Q12)" : "");
    }
  });
}

} // namespace

DOTEK_LINT_RULE(suf_shift_kept){
    .severity = Severity::Warning,
    .check = checkSufPrograms<checkProgram>,
};

} // namespace dotek::lint::rule
