// NC words: decimal points, arguments of calls, positions that are read too early.
#include "frontend/macrob/Calls.h"
#include "frontend/macrob/CheckParts.h"
#include "frontend/macrob/Format.h"
#include "frontend/macrob/Walk.h"
#include "support/messages/MacroB.h"
#include "support/messages/Nc.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace dotek::frontend::macrob {
namespace {

bool isOneOf(char letter, std::string_view letters) {
  return letters.find(letter) != std::string_view::npos;
}

constexpr std::string_view kAxes = "XYZABCUVW";

class WordCheck {
public:
  WordCheck(const Program& program, const CheckContext& context) : program_(program), context_(context) {}

  void run() {
    for (const Block& block : program_.blocks) {
      earlyPosition(block);
      const auto* words = std::get_if<Words>(&block.body);
      if (words == nullptr) continue;
      const std::optional<Call> called = callOf(*words);
      if (called && called->kind <= CallKind::EachBlock)
        call(*called);
      else if (const nc::Word* program = lostCall(*words))
        context_.report<diag::CallWordsAlone>(program->range, wordText(*program));
      else
        plain(*words);
      if (called && called->kind == CallKind::Subprogram && called->program == nullptr)
        context_.report<diag::CallWithoutProgram>(called->code->range);
    }
  }

private:
  const stdlib::Control* control() const { return context_.control; }
  bool countsIncrements(char letter) const {
    return control() != nullptr && control()->countsIncrements(letter);
  }

  // The word is a length in this block. K is one of an arc, and counts the repeats of a canned cycle; Q is
  // one of a canned cycle, and chooses a mode elsewhere (G5.1 Q1).
  bool measures(const Words& words, char address) const {
    if (address != 'K' && address != 'Q') return true;
    return std::any_of(words.words.begin(), words.words.end(), [&](const nc::Word& word) {
      const std::optional<double> code = word.address == 'G' ? literal(word) : std::nullopt;
      if (!code || !(*code >= 0 && *code < 1e5)) return false;
      const stdlib::CodeInfo* info =
          control()->find('G', static_cast<std::uint32_t>(std::lround(*code * 10)));
      if (info == nullptr) return false;
      using stdlib::Function;
      return address == 'K'
                 ? info->function == Function::ArcClockwise || info->function == Function::ArcCounterClockwise
                 : info->function == Function::CannedCycle || info->function == Function::BackBoring;
    });
  }

  // Digits without a point, other than 0.
  static const nc::Number* withoutPoint(const nc::Word& word) {
    if (word.value == nullptr || word.value->brackets > 0) return nullptr;
    const Expression* value = word.value.get();
    if (const auto* negated = std::get_if<nc::Negated>(&value->node)) value = negated->operand.get();
    const auto* number = std::get_if<nc::Number>(&value->node);
    return number != nullptr && !number->point && number->value != 0 ? number : nullptr;
  }

  // ---- NC blocks

  // P with the number of a builder's or vendor's macro, in a block without any code.
  static const nc::Word* lostCall(const Words& words) {
    const nc::Word* program = nullptr;
    for (const nc::Word& word : words.words) {
      if (word.address == 'G' || word.address == 'M') return nullptr;
      const std::optional<double> number = literal(word);
      if (word.address == 'P' && number && *number >= 9000 && *number <= 9999) program = &word;
    }
    return program;
  }

  void plain(const Words& words) {
    for (const nc::Word& word : words.words) {
      if (word.value == nullptr) continue;
      const auto* number = std::get_if<nc::Number>(&word.value->node);
      if (isOneOf(word.address, "MST") && number != nullptr && number->point && word.value->brackets == 0)
        context_.report<diag::CodeWithPoint>(word.range, wordText(word));
      if (countsIncrements(word.address) && measures(words, word.address)) {
        if (const nc::Number* digits = withoutPoint(word))
          context_.report<diag::WordWithoutPoint>(word.range, wordText(word), millimetres(*digits),
                                                  wordText(word) + ".");
      }
    }
  }

  static std::string wordText(const nc::Word& word) { return word.address + print(*word.value); }
  std::string millimetres(const nc::Number& number) const {
    return fmt::format("{:.{}f}", number.value * control()->increment, control()->decimals);
  }

  // ---- calls

  void call(const Call& call) {
    const std::string name = call.kind == CallKind::Simple       ? "G65"
                             : call.kind == CallKind::AfterMoves ? "G66"
                                                                 : "G66.1";
    if (call.program == nullptr) context_.report<diag::CallWithoutProgram>(call.code->range);
    for (const nc::Word* word : call.before)
      if (!isOneOf(word->address, "GMN"))
        context_.report<diag::ArgumentBeforeCall>(word->range, wordText(*word), name);
    for (const nc::Word* word : call.refused)
      if (call.kind != CallKind::EachBlock || word->address != 'G')
        context_.report<diag::NoArgument>(word->range, std::string(1, word->address), name);
    std::map<std::uint32_t, const nc::Word*> set;
    for (const CallArgument& argument : call.arguments) {
      if (argument.variable == 0) {
        context_.report<diag::NoArgument>(argument.word->range, wordText(*argument.word), name);
        continue;
      }
      if (argument.outOfOrder)
        context_.report<diag::ArgumentOrder>(argument.word->range, std::string(1, argument.word->address),
                                             argument.variable);
      const auto [other, first] = set.emplace(argument.variable, argument.word);
      if (!first) {
        context_
            .report<diag::ArgumentOverwritten>(argument.word->range, argument.variable,
                                               wordText(*argument.word))
            .note(other->second->range, "the value that is lost");
        other->second = argument.word;
      }
      const nc::Number* digits = withoutPoint(*argument.word);
      if (digits != nullptr && countsIncrements(argument.word->address))
        context_.report<diag::ArgumentWithoutPoint>(argument.word->range, wordText(*argument.word),
                                                    millimetres(*digits), wordText(*argument.word) + ".");
    }
  }

  // ---- look-ahead

  // A position of a moving axis: machine, work, skip.
  bool isPosition(std::uint32_t number) const {
    const stdlib::SystemVariables& variables = control()->variables;
    for (const std::optional<int>& first : {variables.machine, variables.position, variables.skip})
      if (first && number >= static_cast<std::uint32_t>(*first) &&
          number < static_cast<std::uint32_t>(*first) + 6)
        return true;
    return false;
  }

  void earlyPosition(const Block& block) {
    if (control() == nullptr) return;
    if (moving_ != nullptr) {
      walk(block, [&](const Expression& expression, bool) {
        const auto number = variableNumber(expression);
        if (moving_ == nullptr || !number || !isPosition(*number)) return;
        context_.report<diag::PositionReadEarly>(expression.range, *number)
            .note(moving_->range, "the motion");
        moving_ = nullptr; // told once for each motion
      });
    }
    // Nothing is known of a block that jumps arrive at, or that could not be read.
    if (block.sequenceNumber || std::holds_alternative<Goto>(block.body) ||
        std::holds_alternative<Unread>(block.body))
      moving_ = nullptr;
    if (const auto* words = std::get_if<Words>(&block.body)) moving_ = moves(*words) ? &block : nullptr;
  }

  // An axis moves, and nothing stops the control from reading on.
  static bool moves(const Words& words) {
    bool axis = false;
    for (const nc::Word& word : words.words) {
      axis = axis || isOneOf(word.address, kAxes);
      if (word.address == 'M') return false;
      if (word.address != 'G') continue;
      const auto code = literal(word);
      // Skip, machine coordinates, dwell, calls, data input; codes of the machine's builder.
      if (!code || *code == 31 || *code == 53 || *code == 4 || *code == 10 || *code == 28 || *code == 92 ||
          *code >= 100 || (*code >= 65 && *code <= 67))
        return false;
    }
    return axis;
  }

  const Program& program_;
  const CheckContext& context_;
  const Block* moving_ = nullptr;
};

} // namespace

void checkWords(const Program& program, const CheckContext& context) {
  WordCheck(program, context).run();
}

} // namespace dotek::frontend::macrob
