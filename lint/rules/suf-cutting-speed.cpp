#include "frontend/mikroprog/Motion.h"
#include "lint/SufPrograms.h"

#include "support/Decimal.h"

#include <algorithm>

namespace dotek::lint::rule {
namespace {

// Usual cutting speeds in m/min, which a post may have written as S.
bool isCuttingSpeed(double speed) {
  return speed == 40 || speed == 120 || speed == 150 || speed == 200;
}

constexpr double kMostRatio = 1.25; // of the diameters

void checkProgram(const mikroprog::Reading& reading, Report& report) {
  bool constant = false;                  // in the block before
  const mikroprog::Block* base = nullptr; // the G96 whose first cut is to come
  double radius = 0;                      // there
  mikroprog::walkMotion(reading, [&](const mikroprog::Block& block, const mikroprog::MotionState& state) {
    const bool begins = block.does("surface-speed");
    if (begins && state.speed && isCuttingSpeed(*state.speed))
      report.at(block.line->range,
                "S{} before G96 looks like a cutting speed; S is in revolutions here: 1000 times the cutting "
                "speed divided by pi and the diameter",
                numberText(*state.speed));
    if (constant && !begins && block.line->find('S') != nullptr &&
        !mikroprog::isCut(block, state, reading.control))
      report.at(block.line->find('S')->range,
                "an S ends G96, and from here on the speed is constant; write G96 A "
                "after it where the cutting speed has to be");
    constant = state.constantSpeed.value_or(false);
    if (begins) {
      base = state.at[0] ? &block : nullptr;
      radius = state.at[0].value_or(0);
    } else if (base != nullptr && mikroprog::isCut(block, state, reading.control)) {
      const double at = state.at[0].value_or(radius);
      if (radius > 0 && at > 0 && std::max(radius, at) > kMostRatio * std::min(radius, at))
        report.at(
            base->line->range,
            "G96 takes the speed and the diameter of this block as its base, and the cut begins at another "
            "diameter (X{} here, X{} there); write G96 where the cut begins (Q27)",
            numberText(2 * radius), numberText(2 * at));
      base = nullptr;
    }
  });
}

} // namespace

DOTEK_LINT_RULE(suf_cutting_speed){
    .severity = Severity::Warning,
    .check = checkSufPrograms<checkProgram>,
};

} // namespace dotek::lint::rule
