#include "lint/SufPrograms.h"

#include <set>

namespace dotek::lint::rule {
namespace {

constexpr std::uint32_t kFromFile = 90; // P90 takes what a function reads from a file

void checkProgram(const mikroprog::Reading& reading, Report& report) {
  std::set<std::uint32_t> set;
  const auto read = [&](const mikroprog::Value& value, SourceRange where) {
    if (value.parameter && !set.contains(*value.parameter))
      report.at(where, "`P{}` is read and nothing before gives it a value", *value.parameter);
  };
  for (const mikroprog::Block& block : reading.blocks) {
    for (const mikroprog::Word& word : block.line->words)
      read(word.value, word.range);
    if (block.does("read-value")) set.insert(kFromFile);
    if (!block.line->assignment) continue;
    for (const mikroprog::Term& term : block.line->assignment->terms)
      read(term.value, term.range);
    set.insert(block.line->assignment->parameter);
  }
}

void check(const Project& project, Report& report) {
  for (const mikroprog::Reading* reading : project.sufPrograms)
    checkProgram(*reading, report);
}

} // namespace

DOTEK_LINT_RULE(suf_parameter_unset){
    .severity = Severity::Warning,
    .check = check,
};

} // namespace dotek::lint::rule
