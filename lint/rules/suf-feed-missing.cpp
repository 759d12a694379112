#include "lint/SufPrograms.h"

#include <algorithm>

namespace dotek::lint::rule {
namespace {

bool isG78(const mikroprog::Code& code) {
  return code.function != nullptr && code.function->code() == "G78";
}

// The first feed move or cycle without one.
void checkProgram(const mikroprog::Reading& reading, Report& report) {
  bool feeds = false; // the motion in force needs a feed
  for (const mikroprog::Block& block : reading.blocks) {
    const mikroprog::Line& line = *block.line;
    if (line.unread) continue;
    if (line.find('F') != nullptr) return;
    for (const std::string_view motion : {"rapid", "feed", "arc-clockwise", "arc-counter-clockwise"})
      if (block.does(motion)) feeds = motion != "rapid";
    const bool axes = std::any_of(line.words.begin(), line.words.end(), [&](const mikroprog::Word& word) {
      return reading.control.hasAxis(word.address);
    });
    const bool other = std::any_of(block.codes.begin(), block.codes.end(), [](const mikroprog::Code& code) {
      return code.function != nullptr && !code.function->addresses.empty() &&
             code.function->group != "motion";
    });
    // G78 has a rule of its own.
    const bool cycle = block.does("cycle") && std::none_of(block.codes.begin(), block.codes.end(), isG78);
    if (!cycle && (!feeds || !axes || other)) continue;
    report.at(line.range, "no feed was given before this {}; the control begins with F0",
              cycle ? "cycle" : "feed move");
    return;
  }
}

} // namespace

DOTEK_LINT_RULE(suf_feed_missing){
    .severity = Severity::Warning,
    .check = checkSufPrograms<checkProgram>,
};

} // namespace dotek::lint::rule
