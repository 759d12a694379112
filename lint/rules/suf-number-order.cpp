#include "lint/SufPrograms.h"

namespace dotek::lint::rule {
namespace {

void check(const Project& project, Report& report) {
  for (const mikroprog::Reading* reading : project.sufPrograms) {
    std::uint64_t last = 0;
    for (std::size_t i = 0; i < reading->blocks.size(); ++i) {
      const mikroprog::Line& line = *reading->blocks[i].line;
      if (!line.number) continue;
      const char* defect = reading->numbers.at(*line.number) != i ? "occurs twice"
                           : *line.number < last                  ? "is smaller than one before"
                                                                  : nullptr;
      if (defect != nullptr)
        report.at(line.numberRange, "the block number {} {}; jumps may go to another block than meant",
                  *line.number, defect);
      last = *line.number;
    }
  }
}

} // namespace

DOTEK_LINT_RULE(suf_number_order){
    .severity = Severity::Warning,
    .check = check,
};

} // namespace dotek::lint::rule
