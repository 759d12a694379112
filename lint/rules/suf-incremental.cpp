#include "frontend/mikroprog/Motion.h"
#include "lint/SufPrograms.h"

namespace dotek::lint::rule {
namespace {

void checkProgram(const mikroprog::Reading& reading, Report& report) {
  bool told = false; // since the last G91
  mikroprog::walkMotion(reading, [&](const mikroprog::Block& block, const mikroprog::MotionState& state) {
    if (block.does("incremental")) told = false;
    if (state.absolute.value_or(true)) return;
    if (reading.control.isDiameter('X') && state.radius != true && mikroprog::onlyMoves(block) &&
        block.line->find('X') != nullptr && !told) {
      told = true;
      report.at(
          block.line->find('X')->range,
          "whether X of a path under G91 is a diameter or a radius is not known (Q9); write G90 and the "
          "coordinate");
    }
    for (const std::string_view leads : {"tool-change", "call", "end"})
      if (block.does(leads))
        report.at(block.line->range, "G91 is in force here{}; write G90 before",
                  leads == "end"    ? " at the end of the program"
                  : leads == "call" ? ", and the subprogram runs with it"
                                    : "");
  });
}

} // namespace

DOTEK_LINT_RULE(suf_incremental){
    .severity = Severity::Warning,
    .check = checkSufPrograms<checkProgram>,
};

} // namespace dotek::lint::rule
