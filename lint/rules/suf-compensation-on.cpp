#include "frontend/mikroprog/Motion.h"
#include "lint/SufPrograms.h"

namespace dotek::lint::rule {
namespace {

bool isDisturbed(std::string_view function) {
  for (const std::string_view other : {"probe-move", "thread-pass", "cycle", "reference", "tool-change"})
    if (function == other) return true;
  return false;
}

void checkProgram(const mikroprog::Reading& reading, Report& report) {
  bool told = false; // since the last G41 or G42
  mikroprog::walkMotion(reading, [&](const mikroprog::Block& block, const mikroprog::MotionState& state) {
    if (block.does("compensation-left") || block.does("compensation-right")) told = false;
    for (const mikroprog::Code& code : block.codes) {
      if (told || !state.compensated || code.function == nullptr || !isDisturbed(code.function->function))
        continue;
      report.at(block.line->range,
                "`{}` while G41 or G42 is in force; compensation is for G0 to G3 alone and may misplace the "
                "tool; write G40 before it",
                code.function->code());
      told = true;
    }
  });
}

} // namespace

DOTEK_LINT_RULE(suf_compensation_on){
    .severity = Severity::Warning,
    .check = checkSufPrograms<checkProgram>,
};

} // namespace dotek::lint::rule
