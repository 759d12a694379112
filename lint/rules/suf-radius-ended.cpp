#include "frontend/mikroprog/Motion.h"
#include "lint/SufPrograms.h"

#include <set>

namespace dotek::lint::rule {
namespace {

void checkProgram(const mikroprog::Reading& reading, Report& report) {
  std::set<double> radii; // X words under G24
  bool ended = false;     // by G90, since
  mikroprog::walkMotion(reading, [&](const mikroprog::Block& block, const mikroprog::MotionState& state) {
    const mikroprog::Word* const x = block.line->find('X');
    if (block.does("radius")) {
      radii.clear();
      ended = false;
    } else if (block.does("absolute") && !radii.empty()) {
      ended = true;
    }
    if (x == nullptr || !x->value.number) return;
    if (state.radius.value_or(false)) {
      radii.insert(*x->value.number);
    } else if (ended && radii.contains(*x->value.number)) {
      report.at(x->range, "`{}` was a radius under G24, and G90 has ended that: it is a diameter here",
                reading.text(x->range));
      ended = false;
    }
  });
}

} // namespace

DOTEK_LINT_RULE(suf_radius_ended){
    .severity = Severity::Warning,
    .check = checkSufPrograms<checkProgram>,
};

} // namespace dotek::lint::rule
