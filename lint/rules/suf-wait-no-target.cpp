#include "lint/SufPrograms.h"

namespace dotek::lint::rule {
namespace {

void checkProgram(const mikroprog::Reading& reading, Report& report) {
  for (const mikroprog::Block& block : reading.blocks)
    if (!block.line->unread && block.does("wait") && block.line->find('L') == nullptr)
      report.at(block.line->range,
                "G5 without L: where the condition does not come in time, the program ends here");
}

} // namespace

DOTEK_LINT_RULE(suf_wait_no_target){
    .severity = Severity::Warning,
    .check = checkSufPrograms<checkProgram>,
};

} // namespace dotek::lint::rule
