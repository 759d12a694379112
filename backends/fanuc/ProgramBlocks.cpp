#include "backends/fanuc/ProgramBlocks.h"

#include "backends/common/PlainText.h"
#include "backends/fanuc/PrintText.h"
#include "ir/Flow.h"
#include "support/messages/Fanuc.h"

#include <algorithm>
#include <fmt/format.h>

namespace dotek::backends::fanuc {

namespace {

bool isPlain(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return c >= ' ' && c <= '~' && c != ')'; });
}

std::string utf8(const std::string& text, SourceRange range, const SourceMap& sources) {
  if (isUtf8(text) || !range.hasPlace()) return text;
  return toUtf8(text, sources.file(range.file).encoding());
}

std::string withoutBrackets(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '(' || c == ')'; }, ' ');
  return text;
}

// Nothing in it can raise an alarm, so that it may be computed or not.
bool isSimple(const ir::ExpressionPtr& expression) {
  if (const auto* machine = std::get_if<ir::MachineVariable>(&expression->node))
    return ir::constantValue(machine->number) != nullptr;
  if (const auto* unary = std::get_if<ir::Unary>(&expression->node)) {
    const bool plain = unary->op == ir::UnaryOp::NullAsZero || unary->op == ir::UnaryOp::Negate ||
                       unary->op == ir::UnaryOp::Absolute;
    return plain && isSimple(unary->operand);
  }
  if (const auto* binary = std::get_if<ir::Binary>(&expression->node))
    return (binary->op == ir::BinaryOp::Add || binary->op == ir::BinaryOp::Subtract) &&
           isSimple(binary->left) && isSimple(binary->right);
  return true;
}

bool isSimple(const ir::ConditionPtr& condition) {
  if (const auto* comparison = std::get_if<ir::Comparison>(&condition->node))
    return isSimple(comparison->left) && isSimple(comparison->right);
  if (const auto* null = std::get_if<ir::IsNull>(&condition->node)) return isSimple(null->value);
  if (const auto* inner = std::get_if<ir::Not>(&condition->node)) return isSimple(inner->inner);
  if (const auto* junction = std::get_if<ir::Junction>(&condition->node))
    return isSimple(junction->left) && isSimple(junction->right);
  return true;
}

} // namespace

std::string commentText(const std::string& text, SourceRange range, const ProgramContext& context) {
  if (isPlain(text)) return text;
  std::string plain = plainText(utf8(text, range, context.sources)).text;
  std::replace(plain.begin(), plain.end(), '(', '[');
  std::replace(plain.begin(), plain.end(), ')', ']');
  context.diagnostics.report<diag::CommentPlain>(range, plain);
  return plain;
}

ProgramBlocks::ProgramBlocks(const ir::Program& program, ProgramNumbers& numbers,
                             const ProgramContext& context, std::vector<EmittedLine>& out)
    : program_(program), numbers_(numbers), context_(context), text_(context.to()), out_(out),
      made_(static_cast<ir::LabelId>(program.labels.size())) {}

void ProgramBlocks::run() {
  nameLabels();
  const std::vector<ir::ProgramStatement>& body = program_.body;
  for (std::size_t begin = 0; begin < body.size();) {
    std::size_t end = begin + 1;
    const std::uint32_t block = body[begin].origin.block;
    while (end < body.size() && block != 0 && body[end].origin.block == block)
      ++end;
    statements(begin, end);
    begin = end;
  }
}

// ---- labels

// After the one statement that the branch passes over; 0: it is no IF with THEN.
std::size_t ProgramBlocks::endOfThen(std::size_t branch) const {
  const std::vector<ir::ProgramStatement>& body = program_.body;
  const auto* node = std::get_if<ir::Branch>(&body[branch].node);
  if (node == nullptr || branch + 2 >= body.size() || !numbers_.digits(node->target).empty()) return 0;
  const std::uint32_t block = body[branch].origin.block;
  const auto* label = std::get_if<ir::Label>(&body[branch + 2].node);
  const bool one = body[branch + 1].origin.block == block && body[branch + 2].origin.block == block;
  return one && block != 0 && label != nullptr && label->label == node->target ? branch + 3 : 0;
}

// Jumps to places without a number that no statement of the language makes by itself.
void ProgramBlocks::nameLabels() {
  std::vector<std::pair<ir::LabelId, SourceRange>> named;
  for (std::size_t i = 0; i < program_.body.size(); ++i) {
    const SourceRange range = program_.body[i].origin.range();
    const auto target = ir::targetOf(program_.body[i]);
    if (target && endOfThen(i) == 0) named.emplace_back(*target, range);
  }
  for (const auto& [id, range] : named)
    if (numbers_.digits(id).empty()) numbers_.add(id, range);
}

void ProgramBlocks::label(ir::LabelId label) {
  const std::string digits = numbers_.digits(label);
  if (digits.empty()) return;
  if (!words_.empty() || !number_.empty()) flush();
  number_ = digits;
}

// ---- lines

void ProgramBlocks::refuse(const char* what) {
  context_.diagnostics.report<diag::StatementNotOfProgram>(range_, what);
}

std::string ProgramBlocks::bounded(std::string text, std::uint32_t most) {
  const std::uint32_t depth = bracketDepth(text);
  if (depth > most)
    context_.diagnostics.report<diag::BracketsThere>(range_, depth, context_.to().title, most);
  return text;
}

std::string ProgramBlocks::condition(const ir::ConditionPtr& condition) {
  const std::string text = text_.condition(condition);
  // The pair of the condition itself does not count.
  bounded(text.substr(1, text.size() - 2), context_.to().bracketDepth);
  return text;
}

void ProgramBlocks::flush() {
  if (number_.empty() && words_.empty() && comments_.empty()) return;
  std::string text = words_.empty() ? "" : blockDelete_;
  const auto add = [&](const std::string& part) {
    if (!text.empty() && text != "/") text += ' ';
    text += part;
  };
  std::size_t next = 0;
  const auto comments = [&](std::size_t upTo) {
    for (; next < comments_.size() && comments_[next].place <= upTo; ++next)
      text += "(" + comments_[next].text + ")";
  };
  if (!number_.empty()) add("N" + number_);
  comments(0);
  for (std::size_t i = 0; i < words_.size(); ++i) {
    add(words_[i]);
    comments(i + 1);
  }
  comments(UINT32_MAX);
  out_.push_back({std::move(text), {}, statement_ == nullptr ? "" : statement_->origin.reason});
  if (range_.hasPlace()) out_.back().ranges.push_back(range_);
  number_.clear();
  words_.clear();
  comments_.clear();
}

void ProgramBlocks::line(std::string statement) {
  if (!words_.empty()) flush();
  words_.push_back(std::move(statement));
  flush();
}

void ProgramBlocks::statements(std::size_t begin, std::size_t end) {
  const std::vector<ir::ProgramStatement>& body = program_.body;
  blockDelete_.clear();
  range_ = body[begin].origin.range();
  for (std::size_t i = begin; i < end; ++i) {
    if (body[i].blockDelete != 0)
      blockDelete_ = body[i].blockDelete == 1 ? "/" : fmt::format("/{}", body[i].blockDelete);
    if (const auto* comment = std::get_if<ir::Comment>(&body[i].node))
      comments_.push_back(
          {body[i].origin.place, commentText(comment->text, body[i].origin.range(), context_)});
  }
  for (std::size_t i = begin; i < end;) {
    statement_ = &body[i];
    if (body[i].origin.range().hasPlace()) range_ = body[i].origin.range();
    std::size_t next = i + 1;
    match(
        body[i], [&](const ir::Label& node) { label(node.label); },
        [&](const ir::NcBlock& node) { words(node.words); }, [&](const ir::Call& node) { call(node); },
        [&](const ir::Exit& node) { exit(node); }, [&](const ir::Branch&) { next = branch(i); },
        [&](const ir::Loop& node) { loop(node); },
        [&](const ir::LoopEnd& node) { line(fmt::format("END{}", node.number)); }, [](const ir::Comment&) {},
        [&](const ir::OneOf<ir::Store, ir::Jump, ir::JumpTo, ir::Raise, ir::Notice, ir::Port, ir::Print,
                            ir::NameVariables> auto&) {
          const std::string text = macro(body[i]);
          if (text.empty())
            refuse("this statement");
          else
            line(text);
        });
    i = next;
  }
  flush();
}

// ---- jumps and loops

bool ProgramBlocks::isSplit(const ir::ConditionPtr& condition) const {
  return !context_.to().joinedConditions && std::holds_alternative<ir::Junction>(condition->node);
}

void ProgramBlocks::demandSimple(const ir::ConditionPtr& condition) {
  if (!isSimple(condition))
    context_.diagnostics.report<diag::JoinedElsewhere>(
        condition->range.hasPlace() ? condition->range : range_, context_.to().title,
        "a part of it that would not be reached may raise an alarm");
}

// IF for each part; where the condition fails, the program goes on after them.
void ProgramBlocks::split(const ir::ConditionPtr& condition, const std::string& target) {
  const auto* junction = std::get_if<ir::Junction>(&condition->node);
  if (junction == nullptr) {
    line("IF" + this->condition(condition) + "GOTO " + target);
    return;
  }
  demandSimple(junction->right);
  if (junction->op == ir::Connective::Or) {
    split(junction->left, target);
    split(junction->right, target);
    return;
  }
  const ir::LabelId behind = made_++;
  numbers_.add(behind, range_);
  split(ir::negate(junction->left), numbers_.target(behind));
  split(junction->right, target);
  label(behind);
}

void ProgramBlocks::jumpWhere(const ir::ConditionPtr& condition, const std::string& target) {
  if (isSplit(condition))
    split(condition, target);
  else
    line("IF" + this->condition(condition) + "GOTO " + target);
}

void ProgramBlocks::skipUnless(const ir::ConditionPtr& condition, ir::LabelId behind,
                               const std::string& statement) {
  if (context_.to().ifThen && !isSplit(condition)) {
    line("IF" + this->condition(condition) + "THEN " + statement);
    return;
  }
  numbers_.add(behind, range_);
  jumpWhere(ir::negate(condition), numbers_.target(behind));
  line(statement);
  label(behind);
  flush();
}

// Gives the statement to go on at.
std::size_t ProgramBlocks::branch(std::size_t at) {
  const auto& node = std::get<ir::Branch>(program_.body[at].node);
  const std::size_t end = endOfThen(at);
  if (end == 0) {
    jumpWhere(node.condition, numbers_.target(node.target));
    return at + 1;
  }
  const ir::ConditionPtr condition = ir::negate(node.condition);
  const ir::ProgramStatement& inner = program_.body[at + 1];
  match(
      inner, [&](const ir::Jump& jump) { jumpWhere(condition, numbers_.target(jump.target)); },
      [&](const ir::JumpTo& jump) {
        jumpWhere(condition, bounded(text_.target(jump.number), context_.to().bracketDepth));
      },
      [&](const ir::OneOf<ir::Store, ir::Raise, ir::Notice, ir::Port, ir::Print, ir::NameVariables, ir::Label,
                          ir::Branch, ir::Comment, ir::NcBlock, ir::Loop, ir::LoopEnd, ir::Call,
                          ir::Exit> auto&) {
        const std::string text = macro(inner);
        if (text.empty())
          refuse("what follows THEN");
        else
          skipUnless(condition, node.target, text);
      });
  return end;
}

void ProgramBlocks::loop(const ir::Loop& loop) {
  const std::string begin = fmt::format("DO{}", loop.number);
  if (!loop.condition) {
    line(begin);
    return;
  }
  // WHILE takes the first part, the others leave the loop: all of them are joined by AND.
  std::vector<ir::ConditionPtr> others;
  ir::ConditionPtr first = loop.condition;
  while (isSplit(first)) {
    const auto& junction = std::get<ir::Junction>(first->node);
    if (junction.op == ir::Connective::Or) {
      context_.diagnostics.report<diag::JoinedElsewhere>(range_, context_.to().title,
                                                         "WHILE with OR has no other form");
      return;
    }
    others.insert(others.begin(), junction.right);
    first = junction.left;
  }
  line("WHILE" + condition(first) + begin);
  for (const ir::ConditionPtr& other : others) {
    demandSimple(other);
    numbers_.add(loop.end, range_);
    jumpWhere(ir::negate(other), numbers_.target(loop.end));
  }
}

// ---- words and statements

void ProgramBlocks::word(char address, const ir::ExpressionPtr& value) {
  words_.push_back(address + bounded(text_.word(value), context_.to().bracketDepth));
}

void ProgramBlocks::words(const std::vector<ir::Word>& words) {
  for (const ir::Word& one : words)
    word(one.address, one.value);
}

void ProgramBlocks::call(const ir::Call& call) {
  switch (call.kind) {
  case ir::CallKind::Macro: words_.push_back("G65"); break;
  case ir::CallKind::AfterMoves: words_.push_back("G66"); break;
  case ir::CallKind::EachBlock: words_.push_back("G66.1"); break;
  case ir::CallKind::Off: words_.push_back("G67"); break;
  case ir::CallKind::Subprogram: words_.push_back("M98"); break;
  }
  if (call.program) word('P', call.program);
  if (call.repeats) word('L', call.repeats);
  for (const ir::CallArgument& argument : call.arguments)
    word(argument.letter, argument.value);
}

void ProgramBlocks::exit(const ir::Exit& exit) {
  words_.push_back("M99");
  if (exit.block) word('P', numbers_.exitTo(exit, range_));
}

std::string ProgramBlocks::message(const std::string& text) {
  const std::string decoded = utf8(text, range_, context_.sources);
  std::string shown = text;
  if (!isPlain(text)) {
    const PlainText plain = plainText(decoded);
    shown = withoutBrackets(plain.text);
    if (!context_.options.plainMessages)
      context_.diagnostics.report<diag::MessageCharacters>(range_, context_.to().title, shown);
  }
  const std::uint32_t most = context_.to().alarmLength;
  if (!context_.same() && shown.size() > most)
    context_.diagnostics.report<diag::MessageLonger>(range_, shown.size(), context_.to().title, most,
                                                     shown.substr(0, most));
  return shown.empty() ? "" : "(" + shown + ")";
}

std::string ProgramBlocks::macro(const ir::ProgramStatement& statement) {
  const std::uint32_t most = context_.to().bracketDepth;
  const stdlib::SystemVariables& variables = context_.to().variables;
  return match(
      statement,
      [&](const ir::Store& node) {
        return bounded(text_.variable(node.number) + "=" + text_.value(node.value), most);
      },
      [&](const ir::Jump& node) { return "GOTO " + numbers_.target(node.target); },
      [&](const ir::JumpTo& node) { return "GOTO " + bounded(text_.target(node.number), most); },
      [&](const ir::Raise& node) {
        return bounded(fmt::format("#{}={}", variables.alarm.value_or(3000), text_.number(node.number)),
                       most) +
               message(node.text);
      },
      [&](const ir::Notice& node) {
        return bounded(fmt::format("#{}={}", variables.message.value_or(3006), text_.number(node.number)),
                       most) +
               message(node.text);
      },
      [](const ir::Port& node) { return portText(node); },
      [](const ir::Print& node) { return printText(node); },
      [](const ir::NameVariables& node) {
        return fmt::format("SETVN {}[{}]", node.first, fmt::join(node.names, ","));
      },
      // What is no macro statement, and what raising has not lowered.
      [](const ir::OneOf<ir::Label, ir::Branch, ir::Comment, ir::NcBlock, ir::Loop, ir::LoopEnd, ir::Call,
                         ir::Exit> auto&) { return std::string(); });
}

} // namespace dotek::backends::fanuc
