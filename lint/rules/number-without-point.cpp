#include "lint/Skips.h"

#include <algorithm>
#include <cmath>

namespace dotek::lint::rule {
namespace {

// Angles and Q are left out: arguments with these letters often choose, as A1, and Q1 chooses a mode.
constexpr std::uint32_t kLengths = stdlib::kLengthAddresses & ~ir::addressBits("ABCQ");
// So many times as many have a point.
constexpr std::size_t kTimes = 3;

struct Number {
  std::string text; // as written
  char letter = 0;
  SourceRange range;
};

void collect(const ir::ProgramStatement& statement, std::vector<Number>& with, std::vector<Number>& without) {
  const auto take = [&](char letter, const ir::ExpressionPtr& value, SourceRange range) {
    if (!ir::isAddressIn(kLengths, letter) || value == nullptr) return;
    const auto* constant = std::get_if<ir::Constant>(&value->node);
    if (constant == nullptr || constant->digits.empty() || constant->value == 0) return;
    (ir::numberWithoutPoint(value) != nullptr ? without : with).push_back({constant->digits, letter, range});
  };
  if (const auto* block = std::get_if<ir::NcBlock>(&statement.node)) {
    // Seconds, and the table of an offset.
    if (hasCode(*block, 'G', 4)) return;
    // K is a length of an arc alone; it counts the holes of a canned cycle.
    const bool arc = hasCode(*block, 'G', 2) || hasCode(*block, 'G', 3);
    for (const ir::Word& word : block->words)
      if (word.address != 'K' || arc) take(word.address, word.value, word.range);
  } else if (const ir::Call* call = callOf(statement)) {
    // Several sets of I, J, K hand a list over, which may hold numbers of anything.
    const auto sets = std::count_if(call->arguments.begin(), call->arguments.end(),
                                    [](const ir::CallArgument& argument) { return argument.letter == 'I'; });
    for (const ir::CallArgument& argument : call->arguments)
      if (sets < 2 || argument.letter < 'I' || argument.letter > 'K')
        take(argument.letter, argument.value, argument.range);
  }
}

void check(const Project& project, Report& report) {
  // A control that is known to count says what it makes of such words: word-without-point.
  if (project.control && project.control->decimalGrade != "assumed") return;
  for (const NcFile& nc : project.programs) {
    if (!nc.lowered) continue;
    std::vector<Number> with, without;
    for (const ir::Program& program : nc.lowered->programs)
      for (const ir::ProgramStatement& statement : program.body)
        collect(statement, with, without);
    if (without.empty() || with.size() + nc.file->leftOut.lengths < kTimes * without.size()) continue;
    for (const Number& number : without)
      report.at(
          number.range,
          "`{0}{1}` has no point, and the other lengths of the file have one; a control that counts least "
          "increments reads thousandths here; write `{0}{1}.`",
          number.letter, number.text);
  }
}

} // namespace

DOTEK_LINT_RULE(number_without_point){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .check = check,
};

} // namespace dotek::lint::rule
