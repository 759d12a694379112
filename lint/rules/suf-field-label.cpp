#include "lint/SufPrograms.h"

#include <set>

namespace dotek::lint::rule {
namespace {

constexpr std::uint32_t kLabel = 200; // M42 H220 is about field 20

void checkProgram(const mikroprog::Reading& reading, Report& report) {
  std::set<std::uint32_t> set; // H of all M42
  for (const mikroprog::Block& block : reading.blocks)
    if (block.does("set-condition"))
      if (const auto number = mikroprog::wholeOf(block.line->find('H'))) set.insert(*number);
  for (const mikroprog::Block& block : reading.blocks) {
    const auto number =
        block.does("set-condition") ? mikroprog::wholeOf(block.line->find('H')) : std::nullopt;
    if (!number || *number < kLabel) continue;
    if (block.line->comment.value_or("").empty())
      report.at(block.line->range, "M42 H{} has no text; in the known programs it is the name of the field",
                *number);
    if (!set.contains(*number - kLabel))
      report.at(block.line->range, "M42 H{} has no M42 H{} beside it; the known programs have both (Q14)",
                *number, *number - kLabel);
  }
}

} // namespace

DOTEK_LINT_RULE(suf_field_label){
    .severity = Severity::Note,
    .check = checkSufPrograms<checkProgram>,
};

} // namespace dotek::lint::rule
