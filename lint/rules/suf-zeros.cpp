#include "lint/SufPrograms.h"

namespace dotek::lint::rule {
namespace {

void checkProgram(const mikroprog::Reading& reading, Report& report) {
  for (const mikroprog::Line& line : reading.program.lines) {
    if (line.unread) continue;
    for (const mikroprog::Word& word : line.words) {
      const std::string& digits = word.value.digits;
      if (std::string_view("XYZIJKR").find(word.address) == std::string_view::npos ||
          digits.find('.') == std::string::npos)
        continue;
      if (digits.back() == '0' || digits.back() == '.')
        report.at(word.range, "`{}` ends in zeros that say nothing; posts write `X1` and `X31.2`",
                  reading.text(word.range));
    }
  }
}

} // namespace

DOTEK_LINT_RULE(suf_zeros){
    .severity = Severity::Note,
    .byDefault = false,
    .check = checkSufPrograms<checkProgram>,
};

} // namespace dotek::lint::rule
