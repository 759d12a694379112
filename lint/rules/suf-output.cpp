#include "lint/SufPrograms.h"

namespace dotek::lint::rule {
namespace {

constexpr std::uint32_t kCoolant = 3; // Q1 and Q2 are the spindle

void check(const Project& project, Report& report) {
  forEachSufBlock(project, [&](const mikroprog::Reading&, const mikroprog::Block& block) {
    const mikroprog::Word* output = block.line->find('Q');
    const std::uint32_t number = mikroprog::wholeOf(output).value_or(0);
    if (number < 1 || number > kCoolant) return;
    for (const mikroprog::Code& code : block.codes)
      if (code.function != nullptr && code.function->find('Q') != nullptr)
        report.at(output->range, "output Q{}: {}", number,
                  number == kCoolant ? "coolant is M8 and M9" : "the spindle is M3, M4 and M5");
  });
}

} // namespace

DOTEK_LINT_RULE(suf_output){
    .severity = Severity::Warning,
    .check = check,
};

} // namespace dotek::lint::rule
