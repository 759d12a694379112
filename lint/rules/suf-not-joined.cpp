#include "frontend/mikroprog/Motion.h"
#include "lint/SufPrograms.h"

namespace dotek::lint::rule {
namespace {

void checkProgram(const mikroprog::Reading& reading, Report& report) {
  constexpr std::size_t kLong = 100; // blocks
  constexpr double kShort = 1;       // mm
  std::size_t run = 0;
  SourceRange first;
  mikroprog::walkMotion(reading, [&](const mikroprog::Block& block, const mikroprog::MotionState& state) {
    double square = 0;
    bool known = mikroprog::isCut(block, state, reading.control) && !block.does("cycle") && !state.joined;
    for (const char axis : reading.control.axes) {
      if (block.line->find(axis) == nullptr) continue;
      const auto way = state.travel(*block.line, axis, reading.control);
      known = known && way;
      square += way.value_or(0) * way.value_or(0);
    }
    if (!known || square > kShort * kShort) {
      run = 0;
      return;
    }
    if (run == 0) first = block.line->range;
    if (++run == kLong)
      report.at(first,
                "more than {} feed moves of less than {} mm without M40; the tool stops at the end of each",
                kLong, kShort);
  });
}

} // namespace

DOTEK_LINT_RULE(suf_not_joined){
    .severity = Severity::Note,
    .byDefault = false,
    .check = checkSufPrograms<checkProgram>,
};

} // namespace dotek::lint::rule
