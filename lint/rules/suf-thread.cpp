#include "frontend/mikroprog/Motion.h"
#include "lint/SufPrograms.h"

#include "support/Decimal.h"

namespace dotek::lint::rule {
namespace {

constexpr double kMostPitch = 3; // mm, found on the machine for G78

bool isThread(const mikroprog::Code& code) {
  return code.function != nullptr &&
         (code.function->code() == "G33" || code.function->code() == "G78" || code.function->code() == "G79");
}

void checkProgram(const mikroprog::Reading& reading, Report& report) {
  bool placed = false; // X was named before
  mikroprog::walkMotion(reading, [&](const mikroprog::Block& block, const mikroprog::MotionState& state) {
    for (const mikroprog::Code& code : block.codes) {
      if (!isThread(code)) continue;
      const std::string name = code.function->code();
      const mikroprog::Word* const pitch = block.line->find('K');
      const mikroprog::Word* const core = block.line->find('X');
      if (state.constantSpeed.value_or(false))
        report.at(code.word->range,
                  "`{}` while G96 is in force: the speed follows the diameter within the thread; "
                  "write an S before it",
                  name);
      if (name != "G78" && pitch != nullptr && pitch->value.number.value_or(0) > kMostPitch)
        report.at(pitch->range,
                  "a pitch of more than {} mm; the control refuses it for G78 and perhaps for `{}`",
                  numberText(kMostPitch), name);
      if (name == "G78" && block.line->find('H') == nullptr)
        report.at(code.word->range,
                  "`G78` without H has no run-out, and the end of the thread may be damaged");
      if (name == "G33" || core == nullptr) continue;
      const auto way = state.travel(*block.line, 'X', reading.control);
      if (!placed)
        report.at(code.word->range,
                  "nothing before this `{}` says where X is; it begins at the outer diameter: "
                  "write G0 with X before it",
                  name);
      else if (way && *way == 0)
        report.at(core->range,
                  "the tool is at this diameter already, and a thread cycle begins at the outer one");
    }
    placed = placed || block.line->find('X') != nullptr;
  });
}

} // namespace

DOTEK_LINT_RULE(suf_thread){
    .severity = Severity::Warning,
    .check = checkSufPrograms<checkProgram>,
};

} // namespace dotek::lint::rule
