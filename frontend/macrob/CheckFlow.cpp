// Loops, jumps, and blocks that never run.
#include "frontend/macrob/BlockWords.h"
#include "frontend/macrob/Calls.h"
#include "frontend/macrob/Check.h"
#include "frontend/macrob/Walk.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <unordered_map>
#include <unordered_set>

namespace dotek::frontend::macrob {
namespace {

constexpr std::size_t kNone = SIZE_MAX;

// A DO with its END, as far as they belong together: indices of blocks; kNone: it has none.
struct Loop {
  std::size_t begin = 0, end = 0;
};

// Pairs DO and END; `told` hears of each defect.
class LoopPairs {
public:
  struct Defects {
    std::function<void(std::size_t block, const Do&, std::optional<std::uint32_t> number)> noNumber;
    std::function<void(const LoopNumber&)> badNumber;
    std::function<void(std::size_t inner, std::size_t outer)> sameNumber;
    std::function<void(std::size_t end, std::size_t open)> crosses;
    std::function<void(std::size_t end)> noDo;
    std::function<void(std::size_t begin)> noEnd;
    std::function<void(std::size_t end)> endNoNumber;
  };

  explicit LoopPairs(const Program& program) : program_(program) {}

  std::vector<Loop> run(const Defects& report) {
    report_ = &report;
    for (std::size_t i = 0; i < program_.blocks.size(); ++i) {
      if (const auto* loop = std::get_if<Do>(&program_.blocks[i].body)) open(i, *loop);
      if (const auto* end = std::get_if<End>(&program_.blocks[i].body)) close(i, *end);
    }
    for (const std::size_t begin : stack_) {
      if (closed_.contains(begin)) continue;
      loops_.push_back({begin, kNone});
      const auto& loop = std::get<Do>(program_.blocks[begin].body);
      if (!loop.loop) report_->noNumber(begin, loop, std::nullopt);
      report_->noEnd(begin);
    }
    return std::move(loops_);
  }

private:
  static std::optional<std::uint32_t> numberOf(const std::optional<LoopNumber>& number) {
    return number ? std::optional(number->value) : std::nullopt;
  }
  std::optional<std::uint32_t> numberAt(std::size_t block) const {
    return numberOf(std::get<Do>(program_.blocks[block].body).loop);
  }

  void checkNumber(const std::optional<LoopNumber>& number) {
    if (number && (number->value < 1 || number->value > 3)) report_->badNumber(*number);
  }

  void open(std::size_t block, const Do& loop) {
    checkNumber(loop.loop);
    std::vector<std::size_t>& same = open_[numberOf(loop.loop)];
    if (loop.loop && !same.empty()) report_->sameNumber(block, same.front());
    same.push_back(block);
    stack_.push_back(block);
  }

  void close(std::size_t block, const End& end) {
    checkNumber(end.loop);
    if (!end.loop) report_->endNoNumber(block);
    if (stack_.empty()) {
      report_->noDo(block);
      return;
    }
    // The innermost with this number or without one; of an END without a number the innermost.
    const std::optional<std::uint32_t> number = numberOf(end.loop);
    std::vector<std::size_t>& same = open_[number ? number : numberAt(stack_.back())];
    std::vector<std::size_t>& bare = open_[std::nullopt];
    std::vector<std::size_t>& found =
        same.empty() || (!bare.empty() && bare.back() > same.back()) ? bare : same;
    if (found.empty()) {
      report_->noDo(block);
      return;
    }
    const std::size_t begin = found.back();
    found.pop_back();
    if (begin != stack_.back()) report_->crosses(block, stack_.back());
    const auto& loop = std::get<Do>(program_.blocks[begin].body);
    if (!loop.loop) report_->noNumber(begin, loop, number);
    loops_.push_back({begin, block});
    closed_.insert(begin);
    while (!stack_.empty() && closed_.erase(stack_.back()) != 0)
      stack_.pop_back();
  }

  const Program& program_;
  const Defects* report_ = nullptr;
  std::vector<std::size_t> stack_;         // DOs from the outermost open one on; the last is open
  std::unordered_set<std::size_t> closed_; // of them: closed before an inner one
  std::map<std::optional<std::uint32_t>, std::vector<std::size_t>> open_; // by number, from the outermost on
  std::vector<Loop> loops_;
};

bool unreadHolds(const Program& program, std::string_view word) {
  return std::any_of(program.blocks.begin(), program.blocks.end(), [&](const Block& block) {
    const auto* unread = std::get_if<Unread>(&block.body);
    return unread != nullptr && unread->text.find(word) != std::string::npos;
  });
}

class Flow {
public:
  Flow(const Program& program, const SourceMap& sources) : program_(program), sources_(sources) {}

  FlowFindings run() {
    loops();
    numbers();
    jumps();
    dead();
    return std::move(found_);
  }

private:
  const Block& block(std::size_t i) const { return program_.blocks[i]; }
  const Do& loopAt(std::size_t i) const { return std::get<Do>(block(i).body); }
  const End& endAt(std::size_t i) const { return std::get<End>(block(i).body); }

  // ---- loops

  void loops() {
    // What could not be read may hold the other half.
    const bool doubtful =
        unreadHolds(program_, "DO") || unreadHolds(program_, "END") || unreadHolds(program_, "WHILE");
    LoopPairs::Defects report;
    report.noNumber = [&](std::size_t, const Do& loop, std::optional<std::uint32_t> number) {
      found_.dosWithoutNumber.emplace_back(&loop, number);
    };
    report.badNumber = [&](const LoopNumber& number) { found_.badNumbers.push_back(&number); };
    report.sameNumber = [&](std::size_t inner, std::size_t outer) {
      found_.numbersInUse.emplace_back(&loopAt(inner), &loopAt(outer));
    };
    report.crosses = [&](std::size_t end, std::size_t open) {
      found_.crossings.emplace_back(&endAt(end), &loopAt(open));
    };
    report.noDo = [&](std::size_t end) {
      if (!doubtful) found_.endsWithoutDo.push_back(&endAt(end));
    };
    report.noEnd = [&](std::size_t begin) {
      if (!doubtful) found_.dosWithoutEnd.push_back(&loopAt(begin));
    };
    report.endNoNumber = [&](std::size_t end) { found_.endsWithoutNumber.push_back(&endAt(end)); };
    loops_ = LoopPairs(program_).run(report);
  }

  // ---- numbers of blocks, jumps

  void numbers() {
    for (std::size_t i = 0; i < program_.blocks.size(); ++i)
      if (block(i).sequenceNumber) numbered_[block(i).sequenceNumber->value].push_back(i);
  }

  // Where the control goes on: searching forward from the jump to the end, then from the top.
  std::size_t targetOf(std::size_t from, std::uint64_t number) const {
    const auto found = numbered_.find(number);
    if (found == numbered_.end()) return kNone;
    const auto behind = std::upper_bound(found->second.begin(), found->second.end(), from);
    return behind != found->second.end() ? *behind : found->second.front();
  }

  // The word that names the block of a local subprogram: M97 P, M98 Q.
  static const nc::Word* localCall(const Block& block) {
    const auto* words = std::get_if<Words>(&block.body);
    if (words == nullptr) return nullptr;
    if (findCode(*words, 'M', 97) != nullptr) return findWord(*words, 'P');
    const auto call = callOf(*words);
    return call && call->kind == CallKind::Subprogram && call->program == nullptr ? call->block : nullptr;
  }

  static std::optional<std::uint64_t> numberOf(const Goto& jump) {
    const std::optional<double> value = literal(*jump.target);
    if (!value || *value < 0 || *value > 1e15) return std::nullopt;
    return static_cast<std::uint64_t>(std::llround(*value));
  }

  // An excerpt: without a header, or with nothing that ends it, parts are elsewhere.
  bool isExcerpt() const {
    if (!program_.name) return true;
    if (program_.closed) return false;
    return std::none_of(program_.blocks.begin(), program_.blocks.end(), [](const Block& one) {
      const auto* words = std::get_if<Words>(&one.body);
      return words != nullptr &&
             (findCode(*words, 'M', 99) != nullptr || findCode(*words, 'M', 30) != nullptr ||
              findCode(*words, 'M', 2) != nullptr);
    });
  }

  void jumps() {
    std::unordered_set<std::uint64_t> wanted, backward; // numbers
    std::unordered_set<std::size_t> reached;            // blocks
    findInnermost();
    for (std::size_t i = 0; i < program_.blocks.size(); ++i) {
      const Goto* jump = gotoOf(block(i));
      if (jump == nullptr) continue;
      const std::optional<std::uint64_t> number = numberOf(*jump);
      if (!number) {
        if (!literal(*jump->target))
          computed_ = true;
        else
          found_.badTargets.push_back(jump->target->range);
        continue;
      }
      wanted.insert(*number);
      const std::size_t target = targetOf(i, *number);
      reached.insert(target);
      if (target <= i) backward.insert(*number);
      if (target == kNone)
        found_.missingTargets[*number].push_back(jump->target->range);
      else
        intoLoop(i, *jump, target);
    }
    for (std::size_t i = 0; i < program_.blocks.size(); ++i) {
      const nc::Word* const called = localCall(block(i));
      const auto number = called == nullptr ? std::nullopt : literal(*called);
      if (called != nullptr && !number) computed_ = true;
      if (!number || *number < 0 || *number > 1e15) continue;
      const auto whole = static_cast<std::uint64_t>(std::llround(*number));
      const std::size_t target = targetOf(i, whole);
      if (target == kNone)
        found_.missingTargets[whole].push_back(called->range);
      else
        locals_.push_back(target);
    }
    incomplete_ = !found_.missingTargets.empty() || unreadHolds(program_, "GOTO");
    if (isExcerpt()) found_.missingTargets.clear();
    for (const auto& [number, blocks] : numbered_) {
      if (blocks.size() < 2 || !wanted.contains(number)) continue;
      // Copies of a section, each with a jump forward to its own block: none of them goes astray.
      if (!computed_ && !backward.contains(number) &&
          std::all_of(blocks.begin(), blocks.end(), [&](std::size_t one) { return reached.contains(one); }))
        continue;
      for (std::size_t i = 1; i < blocks.size(); ++i)
        found_.targetsTwice.push_back(
            {number, block(blocks[i]).sequenceNumber->range, block(blocks[0]).sequenceNumber->range});
    }
  }

  // The innermost loop of each block, where no loops cross.
  void findInnermost() {
    if (!found_.crossings.empty()) return;
    innermost_.assign(program_.blocks.size(), kNone);
    std::unordered_map<std::size_t, std::size_t> begins;
    std::unordered_set<std::size_t> ends;
    for (std::size_t i = 0; i < loops_.size(); ++i) {
      if (loops_[i].end == kNone) continue;
      begins.emplace(loops_[i].begin, i);
      ends.insert(loops_[i].end);
    }
    std::vector<std::size_t> open;
    for (std::size_t at = 0; at < program_.blocks.size(); ++at) {
      innermost_[at] = open.empty() ? kNone : open.back();
      if (ends.contains(at)) open.pop_back();
      if (const auto loop = begins.find(at); loop != begins.end()) open.push_back(loop->second);
    }
  }

  void intoLoop(std::size_t from, const Goto& jump, std::size_t target) {
    std::span<const Loop> loops = loops_;
    // A loop that the jump enters is the innermost one, or all that hold the target hold the jump as well.
    if (!innermost_.empty()) {
      if (innermost_[target] == kNone) return;
      loops = loops.subspan(innermost_[target], 1);
    }
    for (const Loop& loop : loops) {
      if (loop.end == kNone) continue;
      const auto inside = [&](std::size_t at) { return at > loop.begin && at <= loop.end; };
      if (!inside(target) || inside(from)) continue;
      found_.jumpsIntoLoop.push_back({*numberOf(jump), jump.target->range, loopAt(loop.begin).range});
      return;
    }
  }

  // ---- blocks that never run

  void dead() {
    const std::size_t count = program_.blocks.size();
    std::vector<bool> reached(count, false);
    std::vector<std::size_t> work;
    const auto reach = [&](std::size_t at) {
      if (at >= count || reached[at]) return;
      reached[at] = true;
      work.push_back(at);
    };
    reach(0);
    for (const std::size_t at : locals_)
      reach(at);
    if (incomplete_ || computed_ || namesBlocks())
      for (const auto& [number, blocks] : numbered_)
        for (const std::size_t at : blocks)
          reach(at);
    while (!work.empty()) {
      const std::size_t at = work.back();
      work.pop_back();
      const bool always = (std::holds_alternative<Goto>(block(at).body) || endOf(block(at)) != nullptr) &&
                          !block(at).blockDelete;
      if (const Goto* jump = gotoOf(block(at)))
        if (const auto number = numberOf(*jump)) reach(targetOf(at, *number));
      if (!always) reach(at + 1);
    }
    for (std::size_t at = 0; at < count;) {
      if (reached[at]) {
        ++at;
        continue;
      }
      const nc::Word* end = at == 0 ? nullptr : endOf(block(at - 1));
      std::size_t behind = at;
      std::size_t first = kNone;
      for (; behind < count && !reached[behind]; ++behind)
        if (first == kNone && (doesSomething(block(behind)) ||
                               (end != nullptr && std::holds_alternative<End>(block(behind).body))))
          first = behind;
      if (first != kNone && at > 0)
        found_.dead.push_back({block(first).range, block(at - 1).range,
                               behind < count ? "up to " + nameOf(behind) : "to the end of the program",
                               end == nullptr ? "" : wordText(*end)});
      at = behind;
    }
  }

  // M30, M2 or M99; nullptr: the program goes on.
  static const nc::Word* endOf(const Block& one) {
    const auto* words = std::get_if<Words>(&one.body);
    if (words == nullptr || one.repaired) return nullptr;
    for (const double code : {30.0, 2.0, 99.0})
      if (const nc::Word* word = findCode(*words, 'M', code)) return word;
    return nullptr;
  }

  // Something may go to a block by a word: M98 Q, M97 P, contours of a lathe, M99 P of what is called.
  bool namesBlocks() const {
    return std::any_of(program_.blocks.begin(), program_.blocks.end(), [](const Block& one) {
      const auto* words = std::get_if<Words>(&one.body);
      return words != nullptr && hasAny(*words, "PQ");
    });
  }

  std::string nameOf(std::size_t at) const {
    if (block(at).sequenceNumber) return "N" + block(at).sequenceNumber->digits;
    return fmt::format("line {}", sources_.line(block(at).range));
  }

  // A comment or the END of a loop that is left by jumps alone.
  static bool doesSomething(const Block& one) {
    return !std::holds_alternative<std::monostate>(one.body) && !std::holds_alternative<End>(one.body);
  }

  const Program& program_;
  const SourceMap& sources_;
  FlowFindings found_;
  std::vector<Loop> loops_;
  std::vector<std::size_t> innermost_; // index of the loop that holds each block; empty: loops cross
  std::map<std::uint64_t, std::vector<std::size_t>> numbered_;
  std::vector<std::size_t> locals_; // first blocks of local subprograms
  bool computed_ = false;           // a jump goes to a computed number
  bool incomplete_ = false;         // a jump goes nowhere, or was not read
};

} // namespace

FlowFindings flowOf(const Program& program, const SourceMap& sources) {
  return Flow(program, sources).run();
}

// ---- loops

void doWithoutNumber(const CheckedProgram& input, Report& report) {
  for (const auto& [loop, number] : input.flow.dosWithoutNumber) {
    const SourceRange word{loop->range.file, loop->range.end - 2, loop->range.end};
    Diagnostic& told = report.at(
        word, "DO has no number; the control stops with alarm 126; write 1, 2 or 3, the number of its END");
    if (!number) continue;
    const std::string digits = std::to_string(*number);
    told.fix = Fix{
        Fix::Applicability::Display, "write `DO" + digits + "`", {{{word.file, word.end, word.end}, digits}}};
  }
}

void endWithoutNumber(const CheckedProgram& input, Report& report) {
  for (const End* end : input.flow.endsWithoutNumber)
    report.at(end->range, "END has no number; the control stops with alarm 126; write the number of its DO");
}

void loopNumberRange(const CheckedProgram& input, Report& report) {
  for (const LoopNumber* number : input.flow.badNumbers)
    report.at(number->range,
              "a loop cannot have the number {}; the control stops with alarm 126; write 1, 2 or 3",
              number->digits);
}

void loopNumberInUse(const CheckedProgram& input, Report& report) {
  for (const auto& [inner, outer] : input.flow.numbersInUse)
    report
        .at(inner->loop->range,
            "loop {} is open already; the control cannot tell the two ENDs apart; give the inner loop "
            "another number",
            inner->loop->digits)
        .note(outer->range, "the loop that is open");
}

void loopsCross(const CheckedProgram& input, Report& report) {
  for (const auto& [end, open] : input.flow.crossings)
    report
        .at(end->range,
            "this END closes an outer loop before the inner one; the control stops with alarm 124; close "
            "the loops in the reverse order of opening")
        .note(open->range, "this loop is still open");
}

namespace {

// One loop is open and one END has another number: both are halves of one slip.
bool isOtherNumber(const FlowFindings& flow) {
  if (flow.dosWithoutEnd.size() != 1 || flow.endsWithoutDo.size() != 1) return false;
  const Do& loop = *flow.dosWithoutEnd.front();
  const End& end = *flow.endsWithoutDo.front();
  return loop.loop && end.loop && end.range.begin > loop.range.begin;
}

} // namespace

void endWithoutDo(const CheckedProgram& input, Report& report) {
  if (isOtherNumber(input.flow)) {
    const Do& loop = *input.flow.dosWithoutEnd.front();
    const End& end = *input.flow.endsWithoutDo.front();
    Diagnostic& found =
        report.at(end.range,
                  "END {} closes no loop, and DO {} is open here; the control stops with alarm 126 or "
                  "124; write one number in both",
                  end.loop->value, loop.loop->value);
    found.note(loop.range, "the loop");
    found.fix = Fix{Fix::Applicability::Display,
                    fmt::format("write `END{}`", loop.loop->value),
                    {{end.loop->range, std::to_string(loop.loop->value)}}};
    return;
  }
  for (const End* end : input.flow.endsWithoutDo)
    report.at(
        end->range,
        "no DO of this number is open; the control stops with alarm 126; write the DO or take the END out");
}

void doWithoutEnd(const CheckedProgram& input, Report& report) {
  if (isOtherNumber(input.flow)) return;
  for (const Do* loop : input.flow.dosWithoutEnd)
    report.at(loop->range,
              "the loop has no END of its number; the control stops with alarm 124; write it where the "
              "loop ends");
}

// ---- jumps

void gotoTargetMissing(const CheckedProgram& input, Report& report) {
  for (const auto& [number, places] : input.flow.missingTargets) {
    Diagnostic& told = report.at(places.front(),
                                 "the program has no block N{}; the control stops with alarm 128 when it "
                                 "jumps; number the block that is meant",
                                 number);
    for (std::size_t i = 1; i < places.size(); ++i)
      told.note(places[i], "this jump goes there as well");
  }
  for (const SourceRange range : input.flow.badTargets)
    report.at(range,
              "no block has such a number; the control stops with alarm 128 when it jumps; write that of the "
              "block that is meant");
  constexpr std::uint32_t kFourDigits = 9999; // what is documented; of longer numbers nobody is certain
  if (input.control == nullptr || input.control->sequenceLast > kFourDigits) return;
  std::unordered_set<std::uint64_t> numbers; // above
  for (const Block& block : input.program.blocks)
    if (block.sequenceNumber && block.sequenceNumber->value > input.control->sequenceLast)
      numbers.insert(block.sequenceNumber->value);
  if (numbers.empty()) return;
  for (const Block& block : input.program.blocks) {
    const Goto* jump = gotoOf(block);
    const auto number = jump == nullptr ? std::nullopt : literal(*jump->target);
    if (!number || !(*number > input.control->sequenceLast && *number < 1e15) ||
        !numbers.contains(static_cast<std::uint64_t>(*number)))
      continue;
    report.at(jump->target->range,
              "this control searches block numbers up to {}; it stops with alarm 128 when it jumps; give the "
              "block a lower number",
              input.control->sequenceLast);
  }
}

namespace {

// `text` says what of the block's number.
void reportNumbered(const std::vector<FlowFindings::Numbered>& found,
                    fmt::format_string<const std::uint64_t&> text, std::string_view note, Report& report) {
  for (const FlowFindings::Numbered& one : found)
    report.at(one.range, text, one.number).note(one.other, std::string(note));
}

} // namespace

void duplicateTarget(const CheckedProgram& input, Report& report) {
  reportNumbered(input.flow.targetsTwice,
                 "the program has N{} twice, and a jump goes there; the control takes the first one it "
                 "finds forward from the jump; number them apart",
                 "the first", report);
}

void jumpIntoLoop(const CheckedProgram& input, Report& report) {
  reportNumbered(input.flow.jumpsIntoLoop,
                 "block N{} is inside a loop, and the jump comes from outside; the control does not allow "
                 "it; jump to the DO instead",
                 "the loop", report);
}

namespace {

// The comment beside the jump says that it is meant: what is jumped over is switched off by it.
bool isSwitch(const CheckedProgram& input, SourceRange jump) {
  for (const Block& block : input.program.blocks) {
    if (jump.begin < block.range.begin || jump.begin >= block.range.end) continue;
    return std::any_of(block.comments.begin(), block.comments.end(), [](const Comment& comment) {
      std::string text = comment.text;
      std::transform(text.begin(), text.end(), text.begin(),
                     [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
      return text.find("DELETE") != std::string::npos || text.find("REMOVE") != std::string::npos ||
             text.find("ENABLE") != std::string::npos || text.starts_with("IF[");
    });
  }
  return false;
}

} // namespace

void blockNeverRuns(const CheckedProgram& input, Report& report) {
  for (const FlowFindings::Dead& one : input.flow.dead) {
    if (isSwitch(input, one.jump)) continue;
    if (!one.end.empty()) {
      report
          .at(one.range,
              "{} ends the program before this, and nothing jumps here: it never runs this block, {}; take "
              "{} out, or the blocks after it",
              one.end, one.extent, one.end)
          .note(one.jump, "the end");
      continue;
    }
    report
        .at(one.range,
            "no path leads here: the program never runs this block, {}; take the jump before it out, or the "
            "blocks",
            one.extent)
        .note(one.jump, "the jump before it");
  }
}

} // namespace dotek::frontend::macrob
