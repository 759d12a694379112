#include "lint/SufPrograms.h"

#include <set>

namespace dotek::lint::rule {
namespace {

constexpr std::uint32_t kFromFile = 90; // P90 takes what a function reads from a file
constexpr std::uint32_t kFirstCompared = 10, kLastCompared = 18; // conditions

void checkProgram(const mikroprog::Reading& reading, Report& report) {
  std::set<std::uint32_t> set;
  const auto read = [&](const mikroprog::Value& value, SourceRange where) {
    if (value.parameter && !set.contains(*value.parameter))
      report.at(where, "`P{}` is read and nothing before gives it a value", *value.parameter);
  };
  for (const mikroprog::Block& block : reading.blocks) {
    for (const mikroprog::Word& word : block.line->words)
      read(word.value, word.range);
    // Conditions from O10 on compare P90, and M26 writes it.
    const auto condition = mikroprog::wholeOf(block.line->find('O')).value_or(0);
    const bool compares = block.does("jump-if") && condition >= kFirstCompared && condition <= kLastCompared;
    if ((compares || block.does("record-value")) && set.insert(kFromFile).second)
      report.at(block.line->range, "P90 is {} here and nothing before gives it a value",
                compares ? "compared" : "written");
    if (block.does("read-value")) set.insert(kFromFile);
    if (!block.line->assignment) continue;
    for (const mikroprog::Term& term : block.line->assignment->terms)
      read(term.value, term.range);
    set.insert(block.line->assignment->parameter);
  }
}

} // namespace

DOTEK_LINT_RULE(suf_parameter_unset){
    .severity = Severity::Warning,
    .check = checkSufPrograms<checkProgram>,
};

} // namespace dotek::lint::rule
