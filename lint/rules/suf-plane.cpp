#include "lint/SufPrograms.h"

namespace dotek::lint::rule {
namespace {

void checkProgram(const mikroprog::Reading& reading, Report& report) {
  if (reading.control.hasAxis('Y')) return;
  for (const mikroprog::Block& block : reading.blocks)
    for (const mikroprog::Code& code : block.codes)
      if (code.function != nullptr &&
          (code.function->function == "plane-xy" || code.function->function == "plane-yz"))
        report.at(code.word->range, "`{}` on a lathe, which has no Y; its plane is G18",
                  code.function->code());
}

} // namespace

DOTEK_LINT_RULE(suf_plane){
    .severity = Severity::Warning,
    .check = checkSufPrograms<checkProgram>,
};

} // namespace dotek::lint::rule
