#include "lint/SufPrograms.h"

#include <algorithm>

namespace dotek::lint::rule {
namespace {

constexpr std::uint32_t kAccumulator = 90, kFirstCompared = 10, kLastCompared = 18;

bool reads(const mikroprog::Value& value) {
  return value.parameter == kAccumulator;
}

// The block compares or stores P90.
bool uses(const mikroprog::Block& block) {
  const auto condition = mikroprog::wholeOf(block.line->find('O')).value_or(0);
  return block.does("record-value") || (condition >= kFirstCompared && condition <= kLastCompared);
}

void checkProgram(const mikroprog::Reading& reading, Report& report) {
  const bool compared = std::any_of(reading.blocks.begin(), reading.blocks.end(),
                                    [](const auto& block) { return uses(block); });
  bool unread = false; // P90 was set, and nothing has looked at it
  for (const mikroprog::Block& block : reading.blocks) {
    if (block.line->unread) continue;
    for (const mikroprog::Word& word : block.line->words) {
      if (!reads(word.value)) continue;
      unread = false;
      if (compared)
        report.at(word.range,
                  "P90 is what conditions and files use; for a value of your own take another parameter");
    }
    if (uses(block)) unread = false;
    if (block.does("read-value")) {
      if (unread) report.at(block.line->range, "M27 overwrites P90, which was set before and not used");
      unread = false;
    }
    if (!block.line->assignment) continue;
    for (const mikroprog::Term& term : block.line->assignment->terms)
      if (reads(term.value)) unread = false;
    if (block.line->assignment->parameter == kAccumulator) unread = true;
  }
}

} // namespace

DOTEK_LINT_RULE(suf_accumulator){
    .severity = Severity::Warning,
    .check = checkSufPrograms<checkProgram>,
};

} // namespace dotek::lint::rule
