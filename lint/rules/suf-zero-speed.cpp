#include "lint/SufPrograms.h"

namespace dotek::lint::rule {
namespace {

void checkProgram(const mikroprog::Reading& reading, Report& report) {
  for (const mikroprog::Line& line : reading.program.lines)
    if (const mikroprog::Word* speed = line.find('S');
        !line.unread && speed != nullptr && speed->value.number == 0.0)
      report.at(speed->range, "S0 stops the spindle; M5 says that to the reader");
}

} // namespace

DOTEK_LINT_RULE(suf_zero_speed){
    .severity = Severity::Note,
    .check = checkSufPrograms<checkProgram>,
};

} // namespace dotek::lint::rule
