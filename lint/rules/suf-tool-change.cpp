#include "frontend/mikroprog/Motion.h"
#include "lint/SufPrograms.h"

namespace dotek::lint::rule {
namespace {

// A turret has places, which the profile counts; it stops nothing by itself.
bool isTurret(const mikroprog::Block& block) {
  for (const mikroprog::Code& code : block.codes) {
    const auto* tool = code.function == nullptr ? nullptr : code.function->find('T');
    if (tool != nullptr && tool->most) return true;
  }
  return false;
}

// The words of axes as they are written.
std::string placeOf(const mikroprog::Reading& reading, const mikroprog::Block& block) {
  std::string out;
  for (const char axis : reading.control.axes)
    if (const mikroprog::Word* word = block.line->find(axis); word != nullptr)
      out += reading.text(word->range) + " ";
  return out;
}

void checkProgram(const mikroprog::Reading& reading, Report& report) {
  const mikroprog::Block* change = nullptr; // whose next move is to come
  std::string before;                       // place of the move before it
  std::string last;                         // place of the last move; "": none, or it was none in rapid
  bool moved = false;
  mikroprog::walkMotion(reading, [&](const mikroprog::Block& block, const mikroprog::MotionState& state) {
    const bool turret = isTurret(block);
    if (block.does("tool-change") && turret) {
      if (state.turning.value_or(false))
        report.at(block.line->range, "the spindle turns at this M6; the turret does not stop it: write M5");
      if (state.coolant.value_or(false))
        report.at(block.line->range, "the coolant is on at this M6; the turret does not stop it: write M9");
      if (moved && last.empty())
        report.at(block.line->range,
                  "the last move before this M6 is in feed; the control has no safe place of its "
                  "own: write a G0 to one");
      change = moved && !last.empty() ? &block : nullptr;
      before = last;
      return;
    }
    if (!mikroprog::hasAxisWord(block, reading.control) && !block.does("cycle")) return;
    const bool rapid = state.motion == "rapid" && mikroprog::onlyMoves(block);
    last = rapid ? placeOf(reading, block) : "";
    moved = true;
    if (change != nullptr && last != before)
      report.at(block.line->range,
                "the first move after M6 is not the G0 to the safe place before it ({}); the tip "
                "of the new tool is elsewhere",
                before.substr(0, before.size() - 1));
    change = nullptr;
  });
}

} // namespace

DOTEK_LINT_RULE(suf_tool_change){
    .severity = Severity::Warning,
    .check = checkSufPrograms<checkProgram>,
};

} // namespace dotek::lint::rule
