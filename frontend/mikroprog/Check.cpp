#include "frontend/mikroprog/Check.h"

#include <iterator>
#include <map>
#include <set>

namespace dotek::frontend::mikroprog {

namespace {

using stdlib::MikroprogFunction;

// What a code of another control is here; "" where nothing helps.
std::string_view remedy(char letter, std::uint32_t number) {
  struct Row {
    char letter;
    std::uint32_t number;
    std::string_view text;
  };
  static constexpr Row kRows[] = {
      {'G', 20, "; the control counts millimetres alone"},
      {'G', 21, "; the control counts millimetres alone"},
      {'G', 30, "; move with G0 to a safe point"},
      {'G', 32, "; G33 X Z K is a thread pass"},
      {'G', 43, "; M6 applies the correction table"},
      {'G', 49, "; M6 applies the correction table"},
      {'G', 56, "; the stored shifts are G52 to G55"},
      {'G', 57, "; the stored shifts are G52 to G55"},
      {'G', 58, "; the stored shifts are G52 to G55"},
      {'G', 59, "; the stored shifts are G52 to G55"},
      {'G', 65, "; parameters P and G26, G28 or M61 to M68 take its place"},
      {'G', 76, "; G78 is the thread cycle"},
      {'G', 80, "; cycles hold for their block alone"},
      {'G', 84, "; the machine cannot tap"},
      {'G', 97, "; a new S ends G96"},
      {'M', 98, "; G26 L calls a subprogram"},
  };
  for (const Row& row : kRows)
    if (row.letter == letter && row.number == number) return row.text;
  return "";
}

// First blocks of subprograms, each with a place that calls it.
std::map<std::size_t, SourceRange> callsOf(const Reading& reading) {
  std::map<std::size_t, SourceRange> out;
  for (const Block& block : reading.blocks) {
    const Word* target = block.line->find('L');
    if (block.line->unread || !block.does("call") || target == nullptr) continue;
    const auto number = wholeOf(target);
    const auto found = number ? reading.numbers.find(*number) : reading.numbers.end();
    if (found != reading.numbers.end()) out.emplace(found->second, target->range);
  }
  return out;
}

} // namespace

Findings unknownCodes(const Reading& reading) {
  Findings out;
  for (const Block& block : reading.blocks) {
    if (block.line->unread) continue;
    for (const Code& code : block.codes)
      if (code.function == nullptr)
        out.push_back(
            {code.word->range,
             fmt::format("{} does not know `{}`{}", reading.control.title, reading.text(code.word->range),
                         remedy(code.word->address, wholeOf(code.word).value_or(0)))});
  }
  return out;
}

Findings unusableCodes(const Reading& reading) {
  Findings out;
  for (const Block& block : reading.blocks) {
    if (block.line->unread) continue;
    for (const Code& code : block.codes) {
      const MikroprogFunction* function = code.function;
      if (function != nullptr && !function->usable)
        out.push_back(
            {code.word->range, fmt::format("`{}` ({}) cannot be used: {}", function->code(), function->title,
                                           function->notes.empty() ? "" : function->notes.front())});
    }
  }
  return out;
}

Findings missingTargets(const Reading& reading) {
  Findings out;
  std::set<std::uint64_t> twice; // N of several blocks
  for (std::size_t i = 0; i < reading.blocks.size(); ++i)
    if (const auto& number = reading.blocks[i].line->number; number && reading.numbers.at(*number) != i)
      twice.insert(*number);
  for (const Block& block : reading.blocks) {
    const Word* target = block.line->find('L');
    // A parameter after L is none of this check.
    if (block.line->unread || target == nullptr || !target->value.number) continue;
    for (const Code& code : block.codes) {
      const MikroprogFunction* function = code.function;
      if (function == nullptr || function->find('L') == nullptr || function->function == "run-program")
        continue;
      const auto number = wholeOf(target);
      if (!number || !reading.numbers.contains(*number))
        out.push_back({target->range, fmt::format("no block has the number {}; where the jump goes is not "
                                                  "defined",
                                                  target->value.digits)});
      else if (twice.contains(*number))
        out.push_back({target->range, fmt::format("several blocks have the number {}; where the jump goes is "
                                                  "not defined",
                                                  target->value.digits)});
    }
  }
  return out;
}

Findings subprogramsBeforeEnd(const Reading& reading) {
  Findings out;
  for (const auto& [first, where] : callsOf(reading))
    if (!reading.end || first < *reading.end)
      out.push_back(
          {where, fmt::format("the subprogram N{} does not follow M30; the main program would run into it",
                              *reading.program.lines[first].number)});
  return out;
}

Findings subprogramsWithoutReturn(const Reading& reading) {
  std::size_t returns = 0; // number of the last M17 from 1; 0: none
  for (std::size_t i = 0; i < reading.blocks.size(); ++i)
    if (reading.blocks[i].does("return")) returns = i + 1;
  Findings out;
  for (const auto& [first, where] : callsOf(reading))
    if (reading.end && first >= *reading.end && returns < first + 1)
      out.push_back({where, fmt::format("no M17 follows the subprogram N{}; the control stops with an error",
                                        *reading.program.lines[first].number)});
  return out;
}

void refuse(const Reading& reading, Diagnostics& diagnostics) {
  struct Check {
    std::string_view rule;
    Findings (*find)(const Reading& reading);
  };
  static constexpr Check kChecks[] = {
      {"suf-unknown-code", unknownCodes},
      {"suf-unusable-code", unusableCodes},
      {"suf-address-missing", missingAddresses},
      {"suf-address-not-taken", addressesNotTaken},
      {"suf-not-together", addressesNotTogether},
      {"suf-twice", saidTwice},
      {"suf-range", valuesOutOfRange},
      {"suf-decimals", tooManyDecimals},
      {"suf-file-missing", missingFiles},
      {"suf-text-missing", missingTexts},
      {"suf-condition-in-comment", conditionsInComments},
      {"suf-condition", unknownConditions},
      {"suf-power-section", powerSection},
      {"suf-target-missing", missingTargets},
      {"suf-call-layout", subprogramsBeforeEnd},
      {"suf-subprogram-end", subprogramsWithoutReturn},
      {"suf-stray-return", strayReturns},
      {"suf-arc-radius", impossibleArcs},
      {"suf-quarter-circle", unequalQuarters},
      {"suf-thread-feed", threadsWithoutFeed},
      {"suf-feed-unit", feedUnits},
  };
  for (const Check& check : kChecks)
    for (Finding& one : check.find(reading))
      diagnostics.add({check.rule, Severity::Error, one.range, std::move(one.text), {}, {}});
}

} // namespace dotek::frontend::mikroprog
