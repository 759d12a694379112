#include "frontend/mikroprog/Motion.h"
#include "lint/SufPrograms.h"
#include "support/Decimal.h"

#include <cmath>

namespace dotek::lint::rule {
namespace {

void check(const Project& project, Report& report) {
  for (const mikroprog::Reading* reading : project.sufPrograms) {
    mikroprog::walkMotion(*reading, [&](const mikroprog::Block& block, const mikroprog::MotionState& state) {
      const mikroprog::Word* step = block.line->find('W');
      if (step == nullptr || !step->value.number) return;
      const auto depth = state.travel(*block.line, 'Z', reading->control);
      if (!depth || *step->value.number <= std::abs(*depth)) return;
      for (const mikroprog::Code& code : block.codes)
        if (code.function != nullptr && code.function->code() == "G83")
          report.at(
              step->range,
              "`{}` is more than the depth of {} mm, so the drill goes down at once; G81 says that, or a "
              "smaller W",
              reading->text(step->range), numberText(std::round(std::abs(*depth) * 1000) / 1000));
    });
  }
}

} // namespace

DOTEK_LINT_RULE(suf_peck_depth){
    .severity = Severity::Warning,
    .check = check,
};

} // namespace dotek::lint::rule
