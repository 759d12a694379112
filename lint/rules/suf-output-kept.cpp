#include "lint/SufPrograms.h"

#include <map>

namespace dotek::lint::rule {
namespace {

void checkProgram(const mikroprog::Reading& reading, Report& report) {
  std::map<std::uint32_t, SourceRange> on;
  for (const mikroprog::Block& block : reading.blocks) {
    if (block.line->unread) continue;
    for (const mikroprog::Word& word : block.line->words) {
      const auto number = word.address == 'Q' ? mikroprog::wholeOf(&word) : std::nullopt;
      if (!number) continue;
      if (block.does("output-on")) on.emplace(*number, word.range);
      if (block.does("output-off")) on.erase(*number);
    }
  }
  for (const auto& [number, where] : on)
    report.at(where,
              "output Q{} stays on up to the end of the program; write `M21 Q{}` where its work is done",
              number, number);
}

} // namespace

DOTEK_LINT_RULE(suf_output_kept){
    .severity = Severity::Warning,
    .check = checkSufPrograms<checkProgram>,
};

} // namespace dotek::lint::rule
