#include "frontend/macrob/Lower.h"

#include "frontend/macrob/BlockWords.h"
#include "frontend/macrob/Calls.h"
#include "frontend/macrob/Check.h"
#include "frontend/macrob/LowerExpression.h"
#include "frontend/macrob/Walk.h"
#include "stdlib/CalledProgram.h"
#include "support/messages/Common.h"
#include "support/messages/MacroB.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <string_view>
#include <utility>

namespace dotek::frontend::macrob {
namespace {

// The control reaches these while it runs, if ever: an alarm there, no reason not to begin.
bool isForRunTime(std::string_view code, LowerFor use) {
  if (code == gotoTargetMissingCheck.code || code == jumpIntoLoopCheck.code)
    return use != LowerFor::Translation;
  return code == variableOutOfRangeCheck.code || code == nullWrittenCheck.code ||
         code == readOnlyWrittenCheck.code || code == argumentWithoutPointCheck.code ||
         code == wordOutOfRangeCheck.code;
}

constexpr std::size_t kSmall = 1000; // statements

class ProgramLowering {
public:
  ProgramLowering(const Program& program, const stdlib::Control& control, Diagnostics& diagnostics,
                  LowerFor use)
      : program_(program), control_(control), diagnostics_(diagnostics), use_(use) {}

  ir::Program run() {
    name();
    for (std::size_t i = 0; i < program_.blocks.size(); ++i)
      if (const auto& number = program_.blocks[i].sequenceNumber; number && number->value != UINT64_MAX)
        labels_[number->value].push_back({i, out_.addLabel({number->value, number->digits, number->range})});
    out_.body.reserve(2 * program_.blocks.size());
    for (at_ = 0; at_ < program_.blocks.size(); ++at_)
      block(program_.blocks[at_]);
    // Of many small programs the room that is left over adds up; that of a large one is never touched.
    if (out_.body.size() < kSmall) out_.body.shrink_to_fit();
    return std::move(out_);
  }

private:
  struct NumberedBlock {
    std::size_t block;
    ir::LabelId label;
  };
  struct OpenLoop {
    std::uint32_t number;
    ir::LabelId begin, end;
  };

  void name() {
    for (const Comment& comment : program_.comments)
      out_.titleComments.push_back(comment.text);
    if (!program_.name) {
      if (!program_.blocks.empty()) out_.range = program_.blocks.front().range;
      return;
    }
    using Kind = ProgramName::Kind;
    const ProgramName& name = *program_.name;
    out_.range = name.range;
    out_.name = name.text;
    out_.number = name.number;
    out_.nameKind = name.kind == Kind::Number  ? ir::Program::NameKind::Number
                    : name.kind == Kind::Colon ? ir::Program::NameKind::Colon
                                               : ir::Program::NameKind::Name;
  }

  static bool before(const NumberedBlock& one, std::size_t block) { return one.block < block; }

  const Block& here() const { return program_.blocks[at_]; }

  template <class Node> ir::ProgramStatement& add(Node node) {
    ir::ProgramStatement& statement = out_.body.emplace_back();
    statement.node = std::move(node);
    statement.origin.ranges = {here().range};
    statement.origin.block = static_cast<std::uint32_t>(at_ + 1);
    if (here().blockDelete)
      statement.blockDelete = static_cast<std::uint8_t>(here().blockDelete->number.value_or(1));
    return statement;
  }
  // A place that is there whether the block is passed over or not.
  void place(ir::LabelId label) { add(ir::Label{label}).blockDelete = 0; }

  void block(const Block& block) {
    const auto& number = block.sequenceNumber;
    const bool wanted = block.target || use_ != LowerFor::Rules;
    if (number && number->value != UINT64_MAX && wanted) {
      const std::vector<NumberedBlock>& same = labels_.at(number->value);
      place(std::lower_bound(same.begin(), same.end(), at_, before)->label);
    }
    const Comment* message = messageOf(block);
    for (const Comment& comment : block.comments) {
      if (&comment == message) continue;
      ir::ProgramStatement& statement = add(ir::Comment{comment.text});
      statement.blockDelete = 0;
      statement.origin.place = comment.place;
    }
    std::visit([&](const auto& body) { lower(body, message); }, block.body);
  }

  // The text of #3000=1(TEXT): the first comment after the statement.
  const Comment* messageOf(const Block& block) const {
    const auto* assignment = std::get_if<nc::Assignment>(&block.body);
    if (const auto* branch = std::get_if<If>(&block.body); branch != nullptr && branch->then)
      assignment = std::get_if<nc::Assignment>(&branch->statement);
    if (assignment == nullptr || messageVariable(*assignment) == 0) return nullptr;
    for (const Comment& comment : block.comments)
      if (comment.place > 0) return &comment;
    return nullptr;
  }
  // #3000 or #3006; 0: another variable.
  std::uint32_t messageVariable(const nc::Assignment& assignment) const {
    const auto number = literal(*assignment.variable);
    const auto is = [&](std::optional<int> variable) { return variable && number == *variable; };
    if (!is(control_.variables.alarm) && !is(control_.variables.message)) return 0;
    return static_cast<std::uint32_t>(*number);
  }

  // ---- macro statements

  void lower(std::monostate, const Comment*) {}
  void lower(const Unread&, const Comment*) {} // refused before

  void lower(const nc::Assignment& assignment, const Comment* message) {
    const std::uint32_t special = messageVariable(assignment);
    if (special == 0) {
      add(ir::Store{lowerNumber(*assignment.variable, Place::Statement),
                    lowerValue(*assignment.value, Place::Statement)});
      return;
    }
    ir::ExpressionPtr number = lowerNumber(*assignment.value, Place::Statement);
    std::string text = message == nullptr ? "" : message->text;
    if (control_.variables.alarm && special == static_cast<std::uint32_t>(*control_.variables.alarm))
      add(ir::Raise{std::move(number), std::move(text)});
    else
      add(ir::Notice{std::move(number), std::move(text)});
  }

  // The block that the search of the control meets: forward from here, then from the first one.
  std::optional<ir::LabelId> target(const Goto& jump) const {
    const auto number = literal(*jump.target);
    if (!number || *number < 1 || *number > control_.sequenceLast || *number != std::floor(*number))
      return std::nullopt;
    const auto found = labels_.find(static_cast<std::uint64_t>(*number));
    if (found == labels_.end()) return std::nullopt;
    const auto next = std::lower_bound(found->second.begin(), found->second.end(), at_ + 1, before);
    return next == found->second.end() ? found->second.front().label : next->label;
  }
  void lower(const Goto& jump, const Comment*) {
    if (const auto label = target(jump))
      add(ir::Jump{*label});
    else
      add(ir::JumpTo{lowerNumber(*jump.target, Place::Statement)});
  }

  void lower(const If& branch, const Comment* message) {
    ir::ConditionPtr condition = lowerCondition(*branch.condition);
    if (const auto* jump = std::get_if<Goto>(&branch.statement)) {
      if (const auto label = target(*jump)) {
        add(ir::Branch{std::move(condition), *label});
        return;
      }
    }
    const ir::LabelId behind = out_.addLabel({0, "", here().range});
    add(ir::Branch{ir::negate(condition), behind});
    std::visit([&](const auto& statement) { lower(statement, message); }, branch.statement);
    place(behind);
  }

  void lower(const Do& loop, const Comment*) {
    const std::uint32_t number = loop.loop ? loop.loop->value : 0;
    const OpenLoop open{number, out_.addLabel({0, "", here().range}), out_.addLabel({0, "", here().range})};
    place(open.begin);
    add(ir::Loop{number, loop.condition ? lowerCondition(*loop.condition) : nullptr, open.end});
    loops_.push_back(open);
  }
  // The checks have paired the loops.
  void lower(const End&, const Comment*) {
    if (loops_.empty()) return;
    add(ir::LoopEnd{loops_.back().number, loops_.back().begin});
    place(loops_.back().end);
    loops_.pop_back();
  }

  void lower(const Port& port, const Comment*) { add(ir::Port{port.open}); }

  void lower(const Print& print, const Comment*) {
    ir::Print out{print.binary, {}};
    for (const auto& piece : print.pieces) {
      if (const auto* text = std::get_if<PrintedText>(&piece)) {
        out.pieces.push_back({text->text, std::nullopt, 0, 0});
        std::replace(out.pieces.back().text.begin(), out.pieces.back().text.end(), '*', ' ');
        continue;
      }
      const auto& variable = std::get<PrintedVariable>(piece);
      const std::string& format = variable.format;
      const auto digit = [&](std::size_t i) { return static_cast<std::uint32_t>(format[i] - '0'); };
      if (format.size() != (print.binary ? 1 : 2)) return; // a check has refused it
      out.pieces.push_back({"", variable.variable, print.binary ? 0 : digit(0), digit(format.size() - 1)});
    }
    add(std::move(out));
  }

  void lower(const SetNames& names, const Comment*) { add(ir::NameVariables{names.first, names.names}); }

  // ---- blocks of words

  void lower(const Words& words, const Comment*) {
    const std::optional<Call> call = callOf(words);
    if (!call && localCall(words)) return;
    if (!call) {
      std::vector<const nc::Word*> all;
      all.reserve(words.words.size());
      for (const nc::Word& word : words.words)
        all.push_back(&word);
      plain(all);
      return;
    }
    switch (call->kind) {
    case CallKind::Simple: macro(*call, ir::CallKind::Macro); break;
    case CallKind::AfterMoves: macro(*call, ir::CallKind::AfterMoves); break;
    case CallKind::EachBlock: macro(*call, ir::CallKind::EachBlock); break;
    case CallKind::Off:
      plain(others(words, *call));
      add(ir::Call{ir::CallKind::Off, nullptr, nullptr, {}});
      break;
    case CallKind::Subprogram: subprogram(words, *call); break;
    case CallKind::Return:
      plain(others(words, *call));
      add(ir::Exit{valueOf(call->program)});
      break;
    }
  }

  // The number of the block is the only argument of such a call, with no local of its own.
  static ir::Call localCall(const nc::Word& block, const nc::Word* program, const nc::Word* repeats) {
    ir::Call out{ir::CallKind::Subprogram, valueOf(program), valueOf(repeats), {}};
    out.arguments.push_back({block.address, 0, lowerWordValue(*block.value, Place::Statement), block.range});
    return out;
  }

  // M97 P of a Haas.
  bool localCall(const Words& words) {
    constexpr std::uint32_t kLocal = 97;
    const nc::Word* const code = use_ == LowerFor::Translation ? nullptr : findCode(words, 'M', kLocal);
    const char address = code == nullptr ? '\0' : stdlib::localCallAddress(control_, 'M', kLocal);
    const nc::Word* const block = address == 0 ? nullptr : findWord(words, address);
    if (block == nullptr) return false;
    const nc::Word* const repeats = findWord(words, 'L');
    std::vector<const nc::Word*> before;
    for (const nc::Word& word : words.words)
      if (&word != code && &word != block && &word != repeats) before.push_back(&word);
    plain(before);
    add(localCall(*block, nullptr, repeats));
    return true;
  }

  void subprogram(const Words& words, const Call& call) {
    const bool begins = call.block != nullptr && stdlib::localCallAddress(control_, 'M', 98) == 'Q';
    if (begins && use_ != LowerFor::Translation) {
      std::vector<const nc::Word*> before = others(words, call);
      std::erase(before, call.block);
      plain(before);
      add(localCall(*call.block, call.program, call.repeat));
      return;
    }
    if (call.program == nullptr && use_ == LowerFor::Translation) {
      Report report(callWithoutProgramCheck.code, callWithoutProgramCheck.severity, diagnostics_);
      report.at(call.code->range, "the call names no program, but a block of its own one, which is not "
                                  "translated; write that part as a program and call it with `P`");
    }
    plain(others(words, call));
    add(ir::Call{ir::CallKind::Subprogram, valueOf(call.program), valueOf(call.repeat), {}});
  }

  static ir::ExpressionPtr valueOf(const nc::Word* word) {
    return word == nullptr ? nullptr : lowerWordValue(*word->value, Place::Statement);
  }
  static std::vector<const nc::Word*> others(const Words& words, const Call& call) {
    std::vector<const nc::Word*> out;
    for (const nc::Word& word : words.words)
      if (&word != call.code && &word != call.program && &word != call.repeat) out.push_back(&word);
    return out;
  }

  void plain(const std::vector<const nc::Word*>& words) {
    if (words.empty()) return;
    ir::NcBlock block;
    block.words.reserve(words.size());
    for (const nc::Word* word : words) {
      if (isCommaAddress(word->address)) {
        if (use_ == LowerFor::Translation)
          diagnostics_.report<diag::SyntaxError>(
              word->range,
              fmt::format("`{}` changes the corner to the next block, or its direction, and is not "
                          "translated; write the points instead",
                          addressText(word->address)));
        if (use_ != LowerFor::Run) continue; // rules know the programmed points
      }
      block.words.push_back({word->address, lowerWordValue(*word->value, Place::Word), word->range});
    }
    add(std::move(block));
  }

  void macro(const Call& call, ir::CallKind kind) {
    plain(call.before);
    ir::Call out{kind, valueOf(call.program), valueOf(call.repeat), {}};
    for (const CallArgument& argument : call.arguments) {
      if (argument.variable == 0) {
        Report report(noArgumentCheck.code, noArgumentCheck.severity, diagnostics_);
        reportNoArgument(argument.word->range, std::string(1, argument.word->address), "G65", report);
        continue;
      }
      out.arguments.push_back({argument.word->address, argument.variable,
                               lowerWordValue(*argument.word->value, Place::Statement),
                               argument.word->range});
    }
    add(std::move(out));
  }

  const Program& program_;
  const stdlib::Control& control_;
  Diagnostics& diagnostics_;
  LowerFor use_;
  ir::Program out_;
  std::map<std::uint64_t, std::vector<NumberedBlock>> labels_; // by N number, in the order of the text
  std::vector<OpenLoop> loops_;
  std::size_t at_ = 0;
};

// The control stops reading at a `%` after the first block: blocks after it belong to no program before it.
void reportMarks(const File& file, const SourceMap& sources, Diagnostics& diagnostics) {
  const std::string_view bytes = sources.file(file.file).bytes();
  std::optional<std::uint32_t> last; // after the last block or header
  const auto markBefore = [&](const SourceRange& next) -> std::optional<SourceRange> {
    if (!last || next.begin <= *last) return std::nullopt;
    const std::size_t at = bytes.substr(*last, next.begin - *last).find('%');
    if (at == std::string_view::npos) return std::nullopt;
    const auto place = static_cast<std::uint32_t>(*last + at);
    return SourceRange{file.file, place, place + 1};
  };
  for (const Program& program : file.programs) {
    if (program.name) {
      if (const auto at = markBefore(program.name->range)) diagnostics.report<diag::TextBehindEnd>(*at);
      last = program.comments.empty() ? program.name->range.end : program.comments.back().range.end;
    }
    for (const Block& block : program.blocks) {
      if (const auto at = markBefore(block.range)) diagnostics.report<diag::BlocksBehindEnd>(*at);
      last = block.range.end;
    }
  }
}

} // namespace

std::optional<ir::ProgramFile> lower(const File& file, const stdlib::Control& control,
                                     const SourceMap& sources, Diagnostics& diagnostics, LowerFor use) {
  std::vector<const Check<CheckedProgram>*> refusals;
  for (const Check<CheckedProgram>* check : programChecks())
    if (check->severity == Severity::Error && !isForRunTime(check->code, use)) refusals.push_back(check);
  Diagnostics found;
  for (const Program& program : file.programs)
    runChecks<CheckedProgram>(refusals, CheckedProgram(program, &control, sources), found);
  const bool fails = file.hasErrors || found.hasErrors();
  for (Diagnostic& one : found.all())
    diagnostics.add(std::move(one));
  for (const SourceRange& legend : file.legends)
    diagnostics.report<diag::LegendNotRun>(legend);
  if (fails || !file.legends.empty()) return std::nullopt;
  Diagnostics refused;
  reportMarks(file, sources, refused);
  ir::ProgramFile out{file.markFirst, file.markLast, {}};
  for (const Program& program : file.programs)
    out.programs.push_back(ProgramLowering(program, control, refused, use).run());
  for (Diagnostic& one : refused.all())
    diagnostics.add(std::move(one));
  if (refused.hasErrors()) return std::nullopt;
  return out;
}

} // namespace dotek::frontend::macrob
