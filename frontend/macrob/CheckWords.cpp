// NC words: decimal points, arguments of calls.
#include "frontend/macrob/BlockWords.h"
#include "frontend/macrob/Calls.h"
#include "frontend/macrob/Check.h"
#include "stdlib/CalledProgram.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace dotek::frontend::macrob {
namespace {

bool isOneOf(char letter, std::string_view letters) {
  return letters.find(letter) != std::string_view::npos;
}

// Digits without a point, other than 0.
const nc::Number* withoutPoint(const nc::Word& word) {
  if (word.value == nullptr || word.value->brackets > 0) return nullptr;
  const Expression* value = word.value.get();
  if (const auto* negated = std::get_if<nc::Negated>(&value->node)) value = negated->operand.get();
  const auto* number = std::get_if<nc::Number>(&value->node);
  return number != nullptr && !number->point && number->value != 0 ? number : nullptr;
}

// Under G20 the least increment is a ten thousandth of an inch where it is a thousandth of a millimetre.
std::string inLengths(const nc::Word& word, const nc::Number& number, const stdlib::Control& control,
                      bool inch = false) {
  const double value = literal(word).value_or(number.value); // with its sign
  return fmt::format("{:.{}f}", value * control.increment / (inch ? 10 : 1),
                     control.decimals + (inch ? 1 : 0));
}

std::string nameOf(const Call& call) {
  return call.kind == CallKind::Simple ? "G65" : call.kind == CallKind::AfterMoves ? "G66" : "G66.1";
}

// P with the number of a builder's or vendor's macro, in a block without any code.
const nc::Word* lostCall(const Words& words) {
  const nc::Word* program = nullptr;
  for (const nc::Word& word : words.words) {
    if (word.address == 'G' || word.address == 'M') return nullptr;
    const std::optional<double> number = literal(word);
    if (word.address == 'P' && number && *number >= 9000 && *number <= 9999) program = &word;
  }
  return program;
}

} // namespace

// ---- NC blocks

void callWordsAlone(const CheckedProgram& input, Report& report) {
  for (const Words* words : input.plain)
    if (const nc::Word* program = lostCall(*words))
      report.at(
          program->range,
          "`{}` names a macro, and the block has no G65; the control calls nothing, and takes the words for "
          "dwell, speed, offset or motion; write G65 before them",
          wordText(*program));
}

void codeWithPoint(const CheckedProgram& input, Report& report) {
  for (const Words* words : input.plain) {
    if (lostCall(*words) != nullptr) continue;
    // An M code of the builder may call a macro, whose arguments these are.
    const bool builders = std::any_of(words->words.begin(), words->words.end(), [&](const nc::Word& word) {
      constexpr double kFirst = 100;
      const auto code = word.address == 'M' ? literal(word) : std::nullopt;
      return code && *code >= kFirst && *code == std::floor(*code);
    });
    for (const nc::Word& word : words->words) {
      const auto* number = word.value == nullptr ? nullptr : std::get_if<nc::Number>(&word.value->node);
      if (number == nullptr || !number->point || word.value->brackets > 0) continue;
      if (word.address == 'M' || ((word.address == 'S' || word.address == 'T') && !builders))
        report.at(
            word.range,
            "`{}` is a number with a point, and this address takes whole numbers; the control stops with "
            "an alarm; "
            "leave the point out",
            wordText(word));
    }
  }
}

namespace {

// G70 to G76: programs write depths, allowances and retracts in least increments.
bool isCycleOfLathe(const Words& words, const stdlib::Control& control) {
  using stdlib::Function;
  return std::any_of(words.words.begin(), words.words.end(), [&](const nc::Word& word) {
    const std::optional<double> code = word.address == 'G' ? literal(word) : std::nullopt;
    if (!code || !(*code >= 70 && *code < 77)) return false;
    const stdlib::CodeInfo* info = control.find('G', static_cast<std::uint32_t>(std::lround(*code * 10)));
    return info != nullptr &&
           (info->function == Function::ContourFinish || info->function == Function::ContourRough ||
            info->function == Function::PeckAlongZ || info->function == Function::PeckAlongX ||
            info->function == Function::ThreadPasses);
  });
}

// With the point it would be more than any machine travels, turns or waits.
bool isTooLargeWithPoint(const nc::Word& word, const nc::Number& digits, bool inch) {
  constexpr double kTravel = 10'000, kInches = 1000, kTurn = 3600;
  return digits.value >= (isOneOf(word.address, "ABC") ? kTurn : inch ? kInches : kTravel);
}

// The word is a length in this block. K is one of an arc, and counts the repeats of a canned cycle; Q is one
// of a canned cycle, and chooses a mode elsewhere (G5.1 Q1).
bool measures(const Words& words, char address, const stdlib::Control& control) {
  if (control.turning && isCycleOfLathe(words, control)) return address == 'X' || address == 'Z';
  if (address != 'K' && address != 'Q') return true;
  return std::any_of(words.words.begin(), words.words.end(), [&](const nc::Word& word) {
    const std::optional<double> code = word.address == 'G' ? literal(word) : std::nullopt;
    if (!code || !(*code >= 0 && *code < 1e5)) return false;
    const stdlib::CodeInfo* info = control.find('G', static_cast<std::uint32_t>(std::lround(*code * 10)));
    if (info == nullptr) return false;
    using stdlib::Function;
    return address == 'K'
               ? info->function == Function::ArcClockwise || info->function == Function::ArcCounterClockwise
               : info->function == Function::CannedCycle || info->function == Function::BackBoring;
  });
}

} // namespace

void wordWithoutPoint(const CheckedProgram& input, Report& report) {
  if (input.control == nullptr) return;
  const stdlib::Control& control = *input.control;
  bool inch = false;
  constexpr double kSeconds = 1000; // of a dwell
  for (const Words* words : input.plain) {
    if (lostCall(*words) != nullptr) continue;
    if (findCode(*words, 'G', 20) != nullptr) inch = true;
    if (findCode(*words, 'G', 21) != nullptr) inch = false;
    const bool dwells = findCode(*words, 'G', 4) != nullptr;
    for (const nc::Word& word : words->words) {
      if (word.value == nullptr || !control.countsIncrements(word.address)) continue;
      const nc::Number* digits = withoutPoint(word);
      if (digits == nullptr || isTooLargeWithPoint(word, *digits, inch)) continue;
      if (dwells && digits->value >= kSeconds) continue;
      if (measures(*words, word.address, control))
        report.at(word.range,
                  "`{0}` has no point; this control counts least increments and reads {1}; write `{0}.` if "
                  "the larger "
                  "value is meant",
                  wordText(word), inLengths(word, *digits, control, inch));
    }
  }
}

// ---- calls

void callWithoutProgram(const CheckedProgram& input, Report& report) {
  const auto judge = [&](const Call& call) {
    if (call.program == nullptr)
      report.at(call.code->range, "the call names no program; the control stops with an alarm; write `P` and "
                                  "its number");
  };
  for (const Call& call : input.calls)
    judge(call);
  // M98 Q calls a block of the same program on some machines of each control that has it.
  const bool local = input.control == nullptr || stdlib::localCallAddress(*input.control, 'M', 98) == 'Q';
  for (const Call& call : input.subprograms)
    if (!local || call.block == nullptr) judge(call);
}

void argumentBeforeCall(const CheckedProgram& input, Report& report) {
  for (const Call& call : input.calls)
    for (const nc::Word* word : call.before)
      if (!isOneOf(word->address, "GMN"))
        report.at(word->range,
                  "`{0}` precedes {1}; arguments belong after it, and before it the word may be an NC "
                  "word or an "
                  "alarm; write it after {1}",
                  wordText(*word), nameOf(call));
}

void reportNoArgument(SourceRange range, std::string_view word, std::string_view name, Report& report) {
  report.at(range, "`{}` is no argument of {}; the control stops with alarm 129; use another letter", word,
            name);
}

void noArgument(const CheckedProgram& input, Report& report) {
  for (const Call& call : input.calls) {
    for (const nc::Word* word : call.refused)
      if (call.kind != CallKind::EachBlock || word->address != 'G')
        reportNoArgument(word->range, std::string(1, word->address), nameOf(call), report);
    for (const CallArgument& argument : call.arguments)
      if (argument.variable == 0)
        reportNoArgument(argument.word->range, wordText(*argument.word), nameOf(call), report);
  }
}

void argumentOrder(const CheckedProgram& input, Report& report) {
  for (const Call& call : input.calls)
    for (const CallArgument& argument : call.arguments)
      if (argument.variable != 0 && argument.outOfOrder)
        report.at(argument.word->range,
                  "`{}` does not follow in the alphabet, so the control takes it for the next set of I J K "
                  "and sets "
                  "#{}; write I, J, K in this order",
                  argument.word->address, argument.variable);
}

void argumentOverwritten(const CheckedProgram& input, Report& report) {
  for (const Call& call : input.calls) {
    std::map<std::uint32_t, const nc::Word*> set;
    for (const CallArgument& argument : call.arguments) {
      if (argument.variable == 0) continue;
      const auto [other, first] = set.emplace(argument.variable, argument.word);
      if (first) continue;
      report
          .at(argument.word->range, "two arguments set #{}; the later one, `{}`, wins; leave one out",
              argument.variable, wordText(*argument.word))
          .note(other->second->range, "the value that is lost");
      other->second = argument.word;
    }
  }
}

void argumentWithoutPoint(const CheckedProgram& input, Report& report) {
  if (input.control == nullptr) return;
  for (const Call& call : input.calls)
    for (const CallArgument& argument : call.arguments) {
      const nc::Number* digits = withoutPoint(*argument.word);
      if (argument.variable != 0 && digits != nullptr &&
          input.control->countsIncrements(argument.word->address))
        report.at(argument.word->range,
                  "`{0}` has no point; this control counts least increments and hands over {1}; write `{0}.`",
                  wordText(*argument.word), inLengths(*argument.word, *digits, *input.control));
    }
}

} // namespace dotek::frontend::macrob
