// Words of programs on another control: codes, and numbers without a point.
#include "backends/fanuc/ProgramChecks.h"
#include "backends/fanuc/ProgramText.h"
#include "backends/fanuc/SavedModes.h"
#include "ir/Walk.h"
#include "support/Decimal.h"
#include "support/messages/Fanuc.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <set>

namespace dotek::backends::fanuc {

namespace {

using stdlib::CodeInfo;
using stdlib::Function;

std::optional<std::uint32_t> tenthsOf(const ir::ExpressionPtr& value) {
  const double* number = ir::constantValue(value);
  if (number == nullptr || *number < 0 || *number > 99999) return std::nullopt;
  return static_cast<std::uint32_t>(std::lround(*number * 10));
}

std::string codeName(char letter, std::uint32_t tenths) {
  return tenths % 10 == 0 ? fmt::format("{}{}", letter, tenths / 10)
                          : fmt::format("{}{}.{}", letter, tenths / 10, tenths % 10);
}

// Digits without a point, other than 0: what controls count each in its own unit.
const ir::Constant* withoutPoint(const ir::ExpressionPtr& value) {
  const ir::Constant* constant = ir::numberWithoutPoint(value);
  return constant != nullptr && constant->value != 0 ? constant : nullptr;
}

std::string withPoint(double value) {
  const std::string text = numberText(Decimal::of(value).rounded(6).value());
  return text.find('.') == std::string::npos ? text + "." : text;
}

class Words {
public:
  Words(ir::Program& program, const FileModes& modes, const ProgramContext& context)
      : program_(program), modes_(modes), context_(context), text_(context.to()) {
    counts_ = to().decimal != from().decimal ||
              (to().decimal == stdlib::DecimalMode::Increment &&
               (to().increment != from().increment || to().lengths != from().lengths));
  }

  void run() {
    const SavedModes saved(program_, modes_.variables, from());
    for (std::size_t i = 0; i < program_.body.size(); ++i) {
      ir::ProgramStatement& statement = program_.body[i];
      range_ = statement.origin.range();
      match(
          statement, [&](ir::OneOf<ir::NcBlock> auto& node) { words(node, saved, i); },
          [&](ir::OneOf<ir::Call> auto& node) { arguments(node); },
          [&](const ir::OneOf<ir::Exit> auto&) { code('M', 990, range_, true); },
          [](const ir::OneOf<ir::Label, ir::Jump, ir::Branch, ir::Store, ir::Comment, ir::JumpTo, ir::Loop,
                             ir::LoopEnd, ir::Raise, ir::Notice, ir::Port, ir::Print,
                             ir::NameVariables> auto&) {});
    }
  }

private:
  const stdlib::Control& to() const { return context_.to(); }
  const stdlib::Control& from() const { return context_.from(); }
  Diagnostics& diagnostics() { return context_.diagnostics; }

  static bool isFunction(const CodeInfo* info, Function function) {
    return info != nullptr && info->function == function;
  }

  // ---- codes

  // What the control calls for the code: program and kind. nullopt: none.
  static std::optional<std::pair<std::uint32_t, bool>> calledBy(const stdlib::Control& control, char letter,
                                                                std::uint32_t tenths) {
    for (const stdlib::CallCode& call : control.callCodes)
      if (call.program != 0 && call.letter == letter && tenths % 10 == 0 && tenths / 10 >= call.first &&
          tenths / 10 < call.first + call.count)
        return std::pair(call.program + tenths / 10 - call.first, call.macro);
    return std::nullopt;
  }

  // The code of the target with the meaning; 0 where it was refused.
  std::uint32_t code(char letter, std::uint32_t tenths, SourceRange range, bool ofLanguage = false) {
    const CodeInfo* here = from().find(letter, tenths);
    const CodeInfo* there = to().find(letter, tenths);
    const std::string name = codeName(letter, tenths);
    const auto called = calledBy(from(), letter, tenths);
    if (called || calledBy(to(), letter, tenths)) {
      if (called == calledBy(to(), letter, tenths)) return tenths;
      diagnostics().report<diag::CodeElsewhere>(
          range, name,
          fmt::format("calls a program on one of {} and {}, and not the same on the other", from().title,
                      to().title),
          "write what it does in the source");
      return 0;
    }
    const bool plain = here != nullptr && here->function == Function::Other;
    if (here != nullptr && there != nullptr && here->function == there->function &&
        (!plain || here->title == there->title)) {
      if (there->grade == "assumed" && told_.insert(name).second)
        diagnostics().report<diag::CodeAssumed>(range, name, there->title, to().title);
      return tenths;
    }
    if (here == nullptr && there == nullptr && letter == 'M') {
      if (told_.insert(name).second)
        diagnostics().report<diag::BuilderCode>(range, name, from().title, to().title);
      return tenths;
    }
    if (here == nullptr) {
      diagnostics().report<diag::CodeElsewhere>(
          range, name, "is in no table of " + from().title + ", so that what it does is not known",
          fmt::format(
              "{}a file of your own for the control says what it does (`dotek new control NAME --from {}`)",
              letter == 'M' ? fmt::format("where it switches the probe, say so: `--probe-on {0}` or "
                                          "`--probe-off {0}`; else ",
                                          name)
                            : "",
              from().name));
      return 0;
    }
    const CodeInfo* other = plain || ofLanguage ? nullptr : to().find(here->function);
    if (letter == 'M' && there == nullptr && here->function == Function::Auxiliary) {
      if (told_.insert(name).second)
        diagnostics().report<diag::BuilderCode>(range, name, from().title, to().title);
      return tenths;
    }
    if (other != nullptr && letter == 'M' && here->function != Function::Auxiliary && other->letter == 'M') {
      diagnostics().report<diag::CodeMoved>(range, name, here->title, codeName('M', other->tenths),
                                            to().title);
      return other->tenths;
    }
    diagnostics().report<diag::CodeElsewhere>(
        range, name,
        there == nullptr ? fmt::format("({}) is not in the table of {}", here->title, to().title)
                         : fmt::format("is `{}` on {} and `{}` on {}", here->title, from().title,
                                       there->title, to().title),
        "write what it does in the source");
    return 0;
  }

  void codeWord(ir::Word& word, const SavedModes& saved, std::size_t at) {
    const auto tenths = tenthsOf(word.value);
    const SourceRange range = word.range.hasPlace() ? word.range : range_;
    if (tenths) {
      const std::uint32_t there = code(word.address, *tenths, range);
      if (there != 0 && there != *tenths)
        word.value = ir::constant(there / 10.0, word.value->range, codeName(word.address, there).substr(1));
      return;
    }
    // What #4001 gave is a code that the control has, whichever control it is.
    if (word.address == 'G' && saved.restores(word.value, at)) return;
    const bool every = std::all_of(from().codes.begin(), from().codes.end(), [&](const CodeInfo& info) {
      const CodeInfo* there = info.letter == word.address ? to().find(info.letter, info.tenths) : &info;
      return there != nullptr && there->function == info.function;
    });
    if (!every)
      diagnostics().report<diag::CodeComputed>(range, word.address + text_.word(word.value), to().title,
                                               from().title);
  }

  // ---- blocks

  void words(ir::NcBlock& block, const SavedModes& saved, std::size_t at) {
    Block modes;
    for (const ir::Word& word : block.words) {
      const auto tenths = word.address == 'G' ? tenthsOf(word.value) : std::nullopt;
      const CodeInfo* info = tenths ? from().find('G', *tenths) : nullptr;
      modes.dwell = modes.dwell || isFunction(info, Function::Dwell);
      modes.input = modes.input || isFunction(info, Function::DataInput);
      modes.arc = modes.arc || isFunction(info, Function::ArcClockwise) ||
                  isFunction(info, Function::ArcCounterClockwise);
      modes.thread =
          modes.thread || (info != nullptr && info->group == 1 && info->function == Function::Other);
      modes.unknown = modes.unknown || (word.address == 'G' && info == nullptr);
    }
    for (ir::Word& word : block.words) {
      if (word.address == 'G' || word.address == 'M') codeWord(word, saved, at);
      if (counts_ && withoutPoint(word.value) != nullptr) point(word, modes);
      if (repeats(word, modes))
        diagnostics().report<diag::RepeatLetter>(word.range, word.address + text_.word(word.value),
                                                 std::string(1, to().repeatLetter), to().title);
    }
  }

  struct Block {
    bool dwell = false, input = false, arc = false, thread = false, unknown = false;
  };

  // The word may repeat a canned cycle, which the target does by another letter.
  bool repeats(const ir::Word& word, const Block& block) const {
    return modes_.canned && word.address == from().repeatLetter && to().repeatLetter != from().repeatLetter &&
           !block.arc && !block.input;
  }

  bool isCertain(char address, const Block& block) const {
    if (modes_.inch || modes_.eachBlock || modes_.computed || block.unknown) return false;
    if (address == 'F') return !modes_.perRevolution && !block.thread;
    if (address == 'K') return block.arc;
    // Whether Q takes a point in every cycle that has it no source says.
    return address != 'Q' && from().isLength(address) && to().isLength(address) &&
           !(block.dwell && (address == 'X' || address == 'U'));
  }

  void point(ir::Word& word, const Block& block) {
    if (ir::isAddressIn(ir::kWholeAddresses, word.address) && !modes_.eachBlock) return;
    if (!isCertain(word.address, block)) return uncertain(word.address, word.value, word.range);
    if (word.address != 'F') word.value = pointed(word.value);
  }

  ir::ExpressionPtr pointed(const ir::ExpressionPtr& value) {
    const double unit = from().decimal == stdlib::DecimalMode::Increment ? from().increment : 1;
    const double length = withoutPoint(value)->value * unit;
    if (!std::exchange(pointTold_, true))
      diagnostics().report<diag::PointWritten>(value->range.hasPlace() ? value->range : range_, from().title,
                                               to().title);
    return ir::constant(length, value->range, withPoint(length));
  }

  void uncertain(char letter, const ir::ExpressionPtr& value, SourceRange range) {
    diagnostics().report<diag::PointUncertain>(range.hasPlace() ? range : range_, letter + text_.word(value),
                                               from().title, to().title);
  }

  // ---- calls

  void arguments(ir::Call& call) {
    switch (call.kind) {
    case ir::CallKind::Macro: code('G', 650, range_, true); break;
    case ir::CallKind::AfterMoves: code('G', 660, range_, true); break;
    case ir::CallKind::EachBlock: code('G', 661, range_, true); break;
    case ir::CallKind::Off: code('G', 670, range_, true); break;
    case ir::CallKind::Subprogram: code('M', 980, range_, true); break;
    }
    for (ir::CallArgument& argument : call.arguments) {
      if (!counts_ || withoutPoint(argument.value) == nullptr ||
          (!from().isLength(argument.letter) && !to().isLength(argument.letter)))
        continue;
      if (modes_.inch || from().isLength(argument.letter) != to().isLength(argument.letter))
        uncertain(argument.letter, argument.value, argument.range);
      else
        argument.value = pointed(argument.value);
    }
  }

  ir::Program& program_;
  const FileModes& modes_;
  const ProgramContext& context_;
  ProgramText text_;
  SourceRange range_;
  bool counts_ = false; // a number without a point counts otherwise on the target
  bool pointTold_ = false;
  std::set<std::string> told_;
};

} // namespace

FileModes::FileModes(const ir::ProgramFile& file, const stdlib::Control& from)
    : variables(modeVariables(file, from)) {
  const auto isFunction = [](const CodeInfo* info, Function function) {
    return info != nullptr && info->function == function;
  };
  for (const ir::Program& program : file.programs) {
    const SavedModes saved(program, variables, from);
    for (std::size_t at = 0; at < program.body.size(); ++at) {
      const auto* call = std::get_if<ir::Call>(&program.body[at].node);
      eachBlock = eachBlock || (call != nullptr && call->kind == ir::CallKind::EachBlock);
      const auto* block = std::get_if<ir::NcBlock>(&program.body[at].node);
      if (block == nullptr) continue;
      for (const ir::Word& word : block->words) {
        if (word.address != 'G') continue;
        const auto tenths = tenthsOf(word.value);
        const CodeInfo* info = tenths ? from.find('G', *tenths) : nullptr;
        computed = computed || (!tenths && !saved.restores(word.value, at));
        inch = inch || isFunction(info, Function::Inch);
        perRevolution = perRevolution || isFunction(info, Function::FeedPerRevolution);
        canned = canned || isFunction(info, Function::CannedCycle) || isFunction(info, Function::BackBoring);
      }
    }
  }
}

void translateWords(ir::Program& program, const FileModes& modes, const ProgramContext& context) {
  Words(program, modes, context).run();
}

} // namespace dotek::backends::fanuc
