#include "tests/unit/SlowMacroB.h"

#include "frontend/macrob/Calls.h"
#include "tests/unit/MacroBHelper.h"
#include "tests/unit/SlowTree.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace dotek::tests {
namespace {

namespace macrob = frontend::macrob;
namespace nc = frontend::nc;
using macrob::Block;
using macrob::Condition;
using macrob::Expression;

using Locals = std::array<SlowValue, 34>; // [0] stays null

struct ModalCall { // G66
  std::size_t routine = 0;
  int repeats = 1;
  Locals locals{};
};

struct Frame {
  std::size_t routine = 0;
  Locals* locals = nullptr;
  int macroDepth = 0;
  int callDepth = 0;
  // Inside a macro that the k-th G66 calls only those below k act; nothing: all.
  std::optional<std::size_t> modalLimit;
};

class Slow {
public:
  Slow(const macrob::File& file, const SourceMap& sources, const MacroSetup& setup)
      : file_(file), sources_(sources), setup_(setup), arithmetic_(setup.decimal8) {}

  MacroOutcome outcome() {
    Locals locals{};
    try {
      start(locals);
    } catch (const SlowStop& stop) {
      out_.ending = stop.kind;
      out_.alarm = stop.alarm;
      out_.reason = stop.reason;
    }
    for (int i = 1; i <= 33; ++i)
      if (!locals[static_cast<std::size_t>(i)].null)
        out_.locals[i] = locals[static_cast<std::size_t>(i)].number;
    for (const auto& [number, value] : common_)
      if (!value.null) out_.common[number] = value.number;
    out_.fragile = arithmetic_.fragile();
    return std::move(out_);
  }

private:
  [[noreturn]] void start(Locals& locals) {
    if (file_.hasErrors || file_.programs.empty()) leftOpen("a block that is not read");
    for (const macrob::Program& program : file_.programs)
      routines_.push_back(routineOf(program));
    Frame frame;
    frame.locals = &locals;
    while (true) {
      const std::optional<double> resume = run(frame);
      if (resume) leftOpen("M99 P of the main program");
      // The table of 1.3 clears locals at M99; whether it means that of the main program is open.
      for (const SlowValue& local : locals)
        if (!local.null) leftOpen("locals after M99 of the main program");
    }
  }

  // ---- blocks

  // Until M99; what its P says.
  std::optional<double> run(Frame& frame) {
    const std::vector<Block>& blocks = routines_[frame.routine].program->blocks;
    std::size_t at = 0;
    returned_ = false;
    while (at < blocks.size()) {
      const Block& block = blocks[at];
      if (++out_.blocks > setup_.budget) throw SlowStop{SlowStop::Kind::Budget, 0, ""};
      out_.line = sources_.file(file_.file).place(block.range.begin).line;
      out_.sequence = block.sequenceNumber ? block.sequenceNumber->value : 0;
      std::size_t next = at + 1;
      if (passedOver(block)) {
        if (std::holds_alternative<macrob::Do>(block.body) || std::holds_alternative<macrob::End>(block.body))
          leftOpen("DO or END passed over");
      } else {
        next = carryOut(block, at, frame);
        if (returned_) {
          returned_ = false;
          return std::exchange(resume_, std::nullopt);
        }
      }
      at = next;
    }
    if (frame.callDepth == 0) throw SlowStop{SlowStop::Kind::TextEnd, 0, ""};
    leftOpen("a subprogram without M99");
  }

  bool passedOver(const Block& block) const {
    return block.blockDelete &&
           setup_.switches.contains(static_cast<int>(block.blockDelete->number.value_or(1)));
  }

  // The block to go on at.
  std::size_t carryOut(const Block& block, std::size_t at, Frame& frame) {
    frame_ = &frame;
    unit_ = 1;
    if (const auto* words = std::get_if<macrob::Words>(&block.body)) return ncBlock(*words, at, frame);
    if (const auto* assignment = std::get_if<nc::Assignment>(&block.body)) {
      assign(*assignment, block);
    } else if (const auto* jump = std::get_if<macrob::Goto>(&block.body)) {
      return jumpTo(*jump, at, frame);
    } else if (const auto* branch = std::get_if<macrob::If>(&block.body)) {
      if (!holds(*branch->condition, 1)) return at + 1;
      if (const auto* target = std::get_if<macrob::Goto>(&branch->statement))
        return jumpTo(*target, at, frame);
      if (const auto* then = std::get_if<nc::Assignment>(&branch->statement)) assign(*then, block);
      if (const auto* then = std::get_if<macrob::Print>(&branch->statement)) print(*then);
      if (const auto* then = std::get_if<macrob::Port>(&branch->statement)) port(*then);
    } else if (const auto* loop = std::get_if<macrob::Do>(&block.body)) {
      return enter(*loop, at, frame);
    } else if (const auto* end = std::get_if<macrob::End>(&block.body)) {
      const std::uint32_t number = loopNumber(end->loop);
      const std::size_t begin = routines_[frame.routine].partner[at];
      if (number < 1 || number > 3 || begin == Routine::kNone) raiseAlarm(126);
      return begin;
    } else if (const auto* printed = std::get_if<macrob::Print>(&block.body)) {
      print(*printed);
    } else if (const auto* opening = std::get_if<macrob::Port>(&block.body)) {
      port(*opening);
    }
    return at + 1;
  }

  std::size_t enter(const macrob::Do& loop, std::size_t at, const Frame& frame) {
    const Routine& routine = routines_[frame.routine];
    const std::uint32_t number = loopNumber(loop.loop);
    if (number < 1 || number > 3) raiseAlarm(126);
    for (const std::size_t outer : routine.loops[at])
      if (loopNumber(std::get<macrob::Do>(routine.program->blocks[outer].body).loop) == number)
        raiseAlarm(126);
    if (routine.partner[at] == Routine::kNone) raiseAlarm(124);
    if (loop.condition && !holds(*loop.condition, 1)) return routine.partner[at] + 1;
    return at + 1;
  }

  // Forward from the block after `at`, then from the top.
  std::size_t find(const Frame& frame, std::size_t at, double number) const {
    if (number < 1 || number > setup_.sequenceLast) raiseAlarm(128);
    const Routine& routine = routines_[frame.routine];
    const std::vector<Block>& blocks = routine.program->blocks;
    for (std::size_t step = 1; step <= blocks.size(); ++step) {
      const std::size_t to = (at + step) % blocks.size();
      if (!blocks[to].sequenceNumber || static_cast<double>(blocks[to].sequenceNumber->value) != number)
        continue;
      const auto& inner = routine.loops[to];
      const auto& here = routine.loops[at];
      if (inner.size() > here.size() || !std::equal(inner.begin(), inner.end(), here.begin()))
        leftOpen("a jump into a loop");
      return to;
    }
    raiseAlarm(128);
  }

  std::size_t jumpTo(const macrob::Goto& jump, std::size_t at, const Frame& frame) {
    return find(frame, at, arithmetic_.whole(number(*jump.target)));
  }

  // ---- values

  SlowValue number(const Expression& expression) {
    if (depth(expression) > 5) raiseAlarm(118);
    return value(expression);
  }

  bool holds(const Condition& condition, std::uint32_t ownBrackets) {
    if (depth(condition) > 5 + ownBrackets) raiseAlarm(118);
    return truth(condition);
  }

  bool truth(const Condition& condition) {
    if (const auto* comparison = std::get_if<macrob::Comparison>(&condition.node)) {
      const SlowValue left = value(*comparison->left);
      const SlowValue right = value(*comparison->right);
      return arithmetic_.compare(comparison->op, left, right);
    }
    const auto& joined = std::get<macrob::JoinedConditions>(condition.node);
    const bool left = truth(*joined.left);
    const bool right = truth(*joined.right);
    return joined.op == "AND" ? left && right : joined.op == "OR" ? left || right : left != right;
  }

  SlowValue value(const Expression& expression) {
    SlowValue out;
    if (const auto* digits = std::get_if<nc::Number>(&expression.node)) {
      if (setup_.decimal8 && digits->digits.size() > (digits->point ? 9u : 8u))
        leftOpen("more than 8 digits");
      out = arithmetic_.held(digits->value, false);
    } else if (const auto* variable = std::get_if<nc::VariableRef>(&expression.node)) {
      out = read(arithmetic_.whole(value(*variable->number)));
    } else if (const auto* negated = std::get_if<nc::Negated>(&expression.node)) {
      out = arithmetic_.negated(value(*negated->operand));
    } else if (const auto* operation = std::get_if<nc::Operation>(&expression.node)) {
      const SlowValue left = value(*operation->left);
      const SlowValue right = value(*operation->right);
      out = arithmetic_.operate(operation->op, left, right);
    } else if (const auto* call = std::get_if<nc::FunctionCall>(&expression.node)) {
      std::vector<SlowValue> arguments;
      for (const auto& argument : call->arguments)
        arguments.push_back(value(*argument));
      out = arithmetic_.apply(call->name, arguments, unit_);
    } else {
      leftOpen("a hole");
    }
    if (expression.brackets > 0) out.null = false; // only the bare variable is null
    return out;
  }

  // ---- variables

  bool isCommon(double number) const {
    return std::any_of(setup_.common.begin(), setup_.common.end(), [&](const std::pair<int, int>& range) {
      return number >= range.first && number <= range.second;
    });
  }

  SlowValue read(double number) {
    if (number == 0) return {};
    if (number >= 1 && number <= 33) return (*frame_->locals)[static_cast<std::size_t>(number)];
    if (isCommon(number)) {
      const auto found = common_.find(static_cast<int>(number));
      return found == common_.end() ? SlowValue{} : found->second;
    }
    if (number < 1000) raiseAlarm(115);
    if (number == 4001 && motion_) return arithmetic_.held(*motion_, false);
    if (number == 4003) return arithmetic_.held(incremental_ ? 91 : 90, false);
    for (const int first : {5001, 5041})
      if (number >= first && number < first + 3)
        return arithmetic_.held(position_[static_cast<std::size_t>(number) - static_cast<std::size_t>(first)],
                                true);
    leftOpen("system variable");
  }

  void assign(const nc::Assignment& assignment, const Block& block) {
    const double to = arithmetic_.whole(number(*assignment.variable));
    const SlowValue from = number(*assignment.value);
    if (to >= 1 && to <= 33) {
      (*frame_->locals)[static_cast<std::size_t>(to)] = from;
    } else if (isCommon(to)) {
      common_[static_cast<int>(to)] = from;
    } else if (to == 3000) {
      const double code = arithmetic_.whole(from);
      const bool text = std::any_of(block.comments.begin(), block.comments.end(),
                                    [](const macrob::Comment& comment) { return comment.place > 0; });
      if (code < 0 || code > 200 || from.null || !text) leftOpen("number or text of #3000");
      raiseAlarm(3000 + static_cast<int>(code));
    } else if (to == 0 || (to >= 4001 && to <= 4130) || (to >= 5001 && to <= 5108)) {
      raiseAlarm(116);
    } else if (to < 1000) {
      raiseAlarm(115);
    } else if (to != 3006) {
      leftOpen("system variable");
    }
  }

  void port(const macrob::Port& port) {
    if (port.open == open_) leftOpen("a port opened or closed twice");
    open_ = port.open;
  }

  void print(const macrob::Print& print) {
    if (print.binary) leftOpen("BPRNT");
    if (!open_) leftOpen("DPRNT before POPEN");
    for (const auto& piece : print.pieces) {
      if (const auto* text = std::get_if<macrob::PrintedText>(&piece)) {
        if (text->text.find(' ') != std::string::npos) leftOpen("blanks in DPRNT");
        std::string out = text->text;
        std::replace(out.begin(), out.end(), '*', ' ');
        out_.output += out;
        continue;
      }
      const auto& variable = std::get<macrob::PrintedVariable>(piece);
      if (variable.format.size() != 2) leftOpen("digits of DPRNT");
      out_.output +=
          arithmetic_.printed(read(variable.variable), variable.format[0] - '0', variable.format[1] - '0');
    }
    out_.output += '\n';
  }

  // ---- NC blocks and calls

  std::size_t ncBlock(const macrob::Words& words, std::size_t at, Frame& frame) {
    const std::optional<macrob::Call> call = macrob::callOf(words);
    std::vector<const nc::Word*> others;
    for (const nc::Word& word : words.words)
      others.push_back(&word);
    if (!call) {
      plain(others, frame);
      return at + 1;
    }
    const bool macro = call->kind == macrob::CallKind::Simple || call->kind == macrob::CallKind::AfterMoves;
    if (call->kind == macrob::CallKind::EachBlock) leftOpen("G66.1");
    if (macro) others = call->before;
    std::erase_if(others, [&](const nc::Word* word) {
      return word == call->code || word == call->program || word == call->repeat;
    });
    if (!others.empty()) {
      if (call->kind == macrob::CallKind::AfterMoves || call->kind == macrob::CallKind::Off ||
          activeModals(frame) > 0)
        leftOpen("a call beside other words");
      plain(others, frame);
    }
    frame_ = &frame;
    unit_ = 1;
    if (call->kind == macrob::CallKind::Return) {
      if (call->repeat != nullptr) leftOpen("M99 L");
      const SlowValue target = call->program == nullptr ? SlowValue{} : wordValue(*call->program);
      returned_ = true;
      if (!target.null) resume_ = arithmetic_.whole(target);
      return at + 1;
    }
    if (call->kind == macrob::CallKind::Off) {
      if (frame.macroDepth > 0) leftOpen("G67 in a macro");
      if (!modals_.empty()) modals_.pop_back();
      return at + 1;
    }
    return macro ? macroCall(*call, at, frame) : subprogram(*call, at, frame);
  }

  std::size_t called(const macrob::Call& call, SlowValue program) {
    if (call.program == nullptr || program.null) raiseAlarm(76);
    const double wanted = arithmetic_.whole(program);
    std::optional<std::size_t> found;
    for (std::size_t i = 0; i < file_.programs.size(); ++i) {
      const auto& name = file_.programs[i].name;
      if (!name || name->kind == macrob::ProgramName::Kind::Name) continue;
      if (static_cast<double>(name->number) != wanted) continue;
      if (found) leftOpen("two programs of one number");
      found = i;
    }
    if (!found) raiseAlarm(78);
    return *found;
  }

  int repeatsOf(SlowValue count) {
    if (count.null) return 1;
    const double repeats = arithmetic_.whole(count);
    if (repeats < 1 || repeats > 9999) leftOpen("L outside 1 to 9999");
    return static_cast<int>(repeats);
  }

  std::size_t macroCall(const macrob::Call& call, std::size_t at, Frame& frame) {
    for (const nc::Word* word : call.refused) {
      if (word->address == 'G') raiseAlarm(129);
      leftOpen("a word that is no argument");
    }
    ModalCall made;
    const SlowValue program = call.program == nullptr ? SlowValue{} : wordValue(*call.program);
    const SlowValue repeats = call.repeat == nullptr ? SlowValue{} : wordValue(*call.repeat);
    for (const macrob::CallArgument& argument : call.arguments) {
      if (argument.variable == 0) leftOpen("more than ten sets of I J K");
      const SlowValue given = wordValue(*argument.word);
      if (!given.null) made.locals[argument.variable] = given;
    }
    made.routine = called(call, program);
    made.repeats = repeatsOf(repeats);
    if (call.kind == macrob::CallKind::AfterMoves) {
      if (frame.macroDepth > 0) leftOpen("G66 in a macro");
      if (modals_.size() >= static_cast<std::size_t>(setup_.macroLevels))
        leftOpen("how many G66 are in force at most");
      modals_.push_back(made);
      return at + 1;
    }
    return goOn(runMacro(made, frame, frame.modalLimit), at, frame);
  }

  std::optional<double> runMacro(const ModalCall& call, const Frame& frame,
                                 std::optional<std::size_t> limit) {
    if (frame.macroDepth + 1 > setup_.macroLevels) raiseAlarm(122);
    if (frame.callDepth + 1 > setup_.callLevels) raiseAlarm(77);
    for (int i = 0; i < call.repeats; ++i) {
      Locals locals = call.locals;
      Frame inner{call.routine, &locals, frame.macroDepth + 1, frame.callDepth + 1, limit};
      const std::optional<double> resume = run(inner);
      if (resume && i + 1 < call.repeats) leftOpen("M99 P before the last repeat");
      if (resume) return resume;
    }
    return std::nullopt;
  }

  std::size_t subprogram(const macrob::Call& call, std::size_t at, Frame& frame) {
    const SlowValue program = call.program == nullptr ? SlowValue{} : wordValue(*call.program);
    const SlowValue repeats = call.repeat == nullptr ? SlowValue{} : wordValue(*call.repeat);
    const std::size_t routine = called(call, program);
    const int count = repeatsOf(repeats);
    if (frame.callDepth + 1 > setup_.callLevels) raiseAlarm(77);
    for (int i = 0; i < count; ++i) {
      Frame inner{routine, frame.locals, frame.macroDepth, frame.callDepth + 1, frame.modalLimit};
      const std::optional<double> resume = run(inner);
      if (resume && i + 1 < count) leftOpen("M99 P before the last repeat");
      if (resume) return goOn(resume, at, frame);
    }
    return at + 1;
  }

  // After a call.
  std::size_t goOn(std::optional<double> resume, std::size_t at, const Frame& frame) const {
    return resume ? find(frame, at, *resume) : at + 1;
  }

  std::size_t activeModals(const Frame& frame) const {
    return frame.modalLimit ? std::min(*frame.modalLimit, modals_.size()) : modals_.size();
  }

  // Null: the word is left out.
  SlowValue wordValue(const nc::Word& word) {
    if (word.value == nullptr) leftOpen("a bare address");
    SlowValue out = number(*word.value);
    const Expression* digits = word.value.get();
    if (const auto* negated = std::get_if<nc::Negated>(&digits->node)) {
      digits = negated->operand.get();
      if (number(*digits).null) leftOpen("a word of minus null");
    }
    const auto* literal = std::get_if<nc::Number>(&digits->node);
    const bool increments = std::string("ABCIJKQRUVWXYZ").find(word.address) != std::string::npos;
    if (literal != nullptr && digits->brackets == 0 && !literal->point && !setup_.calculator && increments)
      out = arithmetic_.held(out.number * 0.001, false);
    return out;
  }

  // G0 G1 G90 G91 X Y Z F M2 M8 M9 M30.
  void plain(const std::vector<const nc::Word*>& words, Frame& frame) {
    std::map<char, double> values;
    std::map<std::string, double> codes;
    for (const nc::Word* word : words) {
      const char letter = word->address;
      const bool axis = letter >= 'X' && letter <= 'Z';
      unit_ = axis ? 0.001 : letter == 'F' ? 0 : 1;
      const SlowValue given = wordValue(*word);
      if (given.null) continue;
      if (letter == 'G' || letter == 'M') {
        const double code = arithmetic_.whole(given);
        const std::string group = letter == 'M' ? "M" : code <= 1 ? "motion" : "distance";
        const bool known = letter == 'M' ? code == 2 || code == 8 || code == 9 || code == 30
                                         : code == 0 || code == 1 || code == 90 || code == 91;
        if (!known || !codes.emplace(group, code).second) leftOpen(std::string(1, letter) + " code");
      } else if (axis || letter == 'F') {
        const double rounded = axis ? arithmetic_.thousandths(given) : given.number;
        if (!values.emplace(letter, rounded).second) leftOpen("an address twice");
        if (std::fabs(rounded) > 99999.999 || (letter == 'F' && rounded < 1)) leftOpen("size of a word");
      } else {
        leftOpen(std::string("word ") + letter);
      }
    }
    unit_ = 1;
    if (codes.contains("motion")) motion_ = codes["motion"];
    if (codes.contains("distance")) incremental_ = codes["distance"] == 91;
    if (values.contains('F')) feed_ = true;
    move(values, frame);
    if (codes.contains("M") && (codes["M"] == 2 || codes["M"] == 30))
      throw SlowStop{SlowStop::Kind::ProgramEnd, 0, ""};
  }

  void move(const std::map<char, double>& values, Frame& frame) {
    bool moves = false;
    for (const char axis : {'X', 'Y', 'Z'}) {
      const auto found = values.find(axis);
      if (found == values.end()) continue;
      moves = true;
      double& place = position_[static_cast<std::size_t>(axis - 'X')];
      place = found->second + (incremental_ ? place : 0);
    }
    if (!moves) return;
    if (!motion_) leftOpen("a move before G0 and G1");
    if (*motion_ == 1 && !feed_) leftOpen("G1 before F");
    out_.positions.push_back(position_);
    const std::size_t active = activeModals(frame);
    if (active == 0) return;
    const ModalCall call = modals_[active - 1];
    if (runMacro(call, frame, active - 1)) leftOpen("M99 P after G66");
  }

  const macrob::File& file_;
  const SourceMap& sources_;
  const MacroSetup& setup_;
  SlowArithmetic arithmetic_;
  MacroOutcome out_;
  std::vector<Routine> routines_;
  std::map<int, SlowValue> common_;
  std::vector<ModalCall> modals_;
  Frame* frame_ = nullptr; // whose locals expressions read
  double unit_ = 1;        // what ROUND rounds to
  bool returned_ = false;
  std::optional<double> resume_; // P of the M99 carried out
  bool open_ = false;            // POPEN
  std::optional<double> motion_; // G0, G1
  bool incremental_ = false;
  bool feed_ = false;
  MacroPosition position_{};
};

} // namespace

MacroOutcome runSlowly(const std::string& text, const MacroSetup& setup) {
  const MacroFile parsed(text);
  return Slow(parsed.file, parsed.sources, setup).outcome();
}

} // namespace dotek::tests
