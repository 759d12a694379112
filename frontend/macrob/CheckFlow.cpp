// Loops, jumps, and blocks that never run.
#include "frontend/macrob/Calls.h"
#include "frontend/macrob/CheckParts.h"
#include "frontend/macrob/Walk.h"
#include "support/messages/MacroB.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <map>
#include <optional>

namespace dotek::frontend::macrob {
namespace {

constexpr std::size_t kNone = SIZE_MAX;

// Pairs DO and END; `told` hears of each defect.
class LoopPairs {
public:
  struct Report {
    std::function<void(std::size_t block, const Do&, std::optional<std::uint32_t> number)> noNumber;
    std::function<void(const LoopNumber&)> badNumber;
    std::function<void(std::size_t inner, std::size_t outer)> sameNumber;
    std::function<void(std::size_t end, std::size_t open)> crosses;
    std::function<void(std::size_t end)> noDo;
    std::function<void(std::size_t begin)> noEnd;
    std::function<void(std::size_t end)> endNoNumber;
  };

  explicit LoopPairs(const Program& program) : program_(program) {}

  std::vector<Loop> run(const Report* report) {
    report_ = report;
    for (std::size_t i = 0; i < program_.blocks.size(); ++i) {
      if (const auto* loop = std::get_if<Do>(&program_.blocks[i].body)) open(i, *loop);
      if (const auto* end = std::get_if<End>(&program_.blocks[i].body)) close(i, *end);
    }
    for (const std::size_t begin : stack_) {
      loops_.push_back({begin, kNone});
      if (report_ != nullptr) {
        const auto& loop = std::get<Do>(program_.blocks[begin].body);
        if (!loop.loop) report_->noNumber(begin, loop, std::nullopt);
        report_->noEnd(begin);
      }
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
    if (report_ != nullptr && number && (number->value < 1 || number->value > 3)) report_->badNumber(*number);
  }

  void open(std::size_t block, const Do& loop) {
    checkNumber(loop.loop);
    if (report_ != nullptr && loop.loop)
      for (const std::size_t outer : stack_)
        if (numberAt(outer) == loop.loop->value) report_->sameNumber(block, outer);
    stack_.push_back(block);
  }

  void close(std::size_t block, const End& end) {
    checkNumber(end.loop);
    if (!end.loop && report_ != nullptr) report_->endNoNumber(block);
    if (stack_.empty()) {
      if (report_ != nullptr) report_->noDo(block);
      return;
    }
    // The innermost with this number; else the innermost without one.
    const std::optional<std::uint32_t> number = numberOf(end.loop);
    auto found = std::find_if(stack_.rbegin(), stack_.rend(),
                              [&](std::size_t at) { return !number || numberAt(at) == number; });
    const auto bare =
        std::find_if(stack_.rbegin(), stack_.rend(), [&](std::size_t at) { return !numberAt(at); });
    if (bare != stack_.rend() && (found == stack_.rend() || bare < found)) found = bare;
    if (found == stack_.rend()) {
      if (report_ != nullptr) report_->noDo(block);
      return;
    }
    const std::size_t begin = *found;
    if (report_ != nullptr) {
      if (begin != stack_.back()) report_->crosses(block, stack_.back());
      const auto& loop = std::get<Do>(program_.blocks[begin].body);
      if (!loop.loop) report_->noNumber(begin, loop, number);
    }
    loops_.push_back({begin, block});
    stack_.erase(std::next(found).base());
  }

  const Program& program_;
  const Report* report_ = nullptr;
  std::vector<std::size_t> stack_;
  std::vector<Loop> loops_;
};

bool unreadHolds(const Program& program, std::string_view word) {
  return std::any_of(program.blocks.begin(), program.blocks.end(), [&](const Block& block) {
    const auto* unread = std::get_if<Unread>(&block.body);
    return unread != nullptr && unread->text.find(word) != std::string::npos;
  });
}

class FlowCheck {
public:
  FlowCheck(const Program& program, const CheckContext& context) : program_(program), context_(context) {}

  void run() {
    loops();
    numbers();
    jumps();
    dead();
  }

private:
  const Block& block(std::size_t i) const { return program_.blocks[i]; }
  const Do& loopAt(std::size_t i) const { return std::get<Do>(block(i).body); }
  const End& endAt(std::size_t i) const { return std::get<End>(block(i).body); }

  // ---- loops

  static Fix numberFix(SourceRange place, std::uint32_t number) {
    const std::string digits = std::to_string(number);
    return {Fix::Applicability::Display,
            "write `DO" + digits + "`",
            {{{place.file, place.end, place.end}, digits}}};
  }

  void loops() {
    // What could not be read may hold the other half.
    const bool doubtful = unreadHolds(program_, "DO") || unreadHolds(program_, "END");
    LoopPairs::Report report;
    report.noNumber = [&](std::size_t, const Do& loop, std::optional<std::uint32_t> number) {
      const SourceRange word{loop.range.file, loop.range.end - 2, loop.range.end};
      Diagnostic& told = context_.report<diag::DoWithoutNumber>(word);
      if (number) told.fix = numberFix(word, *number);
    };
    report.badNumber = [&](const LoopNumber& number) {
      context_.report<diag::LoopNumberRange>(number.range, number.digits);
    };
    report.sameNumber = [&](std::size_t inner, std::size_t outer) {
      context_.report<diag::LoopNumberInUse>(loopAt(inner).loop->range, loopAt(inner).loop->digits)
          .note(loopAt(outer).range, "the loop that is open");
    };
    report.crosses = [&](std::size_t end, std::size_t open) {
      context_.report<diag::LoopsCross>(endAt(end).range).note(loopAt(open).range, "this loop is still open");
    };
    report.noDo = [&](std::size_t end) {
      if (!doubtful) context_.report<diag::EndWithoutDo>(endAt(end).range);
    };
    report.noEnd = [&](std::size_t begin) {
      if (!doubtful) context_.report<diag::DoWithoutEnd>(loopAt(begin).range);
    };
    report.endNoNumber = [&](std::size_t end) { context_.report<diag::EndWithoutNumber>(endAt(end).range); };
    loops_ = LoopPairs(program_).run(&report);
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

  static std::optional<std::uint64_t> numberOf(const Goto& jump) {
    const std::optional<double> value = literal(*jump.target);
    if (!value || *value < 0 || *value > 1e15) return std::nullopt;
    return static_cast<std::uint64_t>(std::llround(*value));
  }

  // An excerpt: without a header or without an end of program, parts are elsewhere.
  bool isExcerpt() const {
    if (!program_.name) return true;
    return std::none_of(program_.blocks.begin(), program_.blocks.end(), [](const Block& one) {
      const auto* words = std::get_if<Words>(&one.body);
      return words != nullptr &&
             (findCode(*words, 'M', 99) != nullptr || findCode(*words, 'M', 30) != nullptr ||
              findCode(*words, 'M', 2) != nullptr);
    });
  }

  void jumps() {
    std::map<std::uint64_t, std::vector<SourceRange>> missing;
    std::vector<std::uint64_t> wanted;
    for (std::size_t i = 0; i < program_.blocks.size(); ++i) {
      const Goto* jump = gotoOf(block(i));
      if (jump == nullptr) continue;
      const std::optional<std::uint64_t> number = numberOf(*jump);
      if (!number) {
        if (!literal(*jump->target)) computed_ = true;
        continue;
      }
      wanted.push_back(*number);
      const std::size_t target = targetOf(i, *number);
      if (target == kNone)
        missing[*number].push_back(jump->target->range);
      else
        intoLoop(i, *jump, target);
    }
    incomplete_ = !missing.empty() || unreadHolds(program_, "GOTO");
    if (!isExcerpt()) {
      for (const auto& [number, places] : missing) {
        Diagnostic& told = context_.report<diag::GotoTargetMissing>(places.front(), number);
        for (std::size_t i = 1; i < places.size(); ++i)
          told.note(places[i], "this jump goes there as well");
      }
    }
    for (const auto& [number, blocks] : numbered_) {
      if (blocks.size() < 2 || std::find(wanted.begin(), wanted.end(), number) == wanted.end()) continue;
      for (std::size_t i = 1; i < blocks.size(); ++i)
        context_.report<diag::DuplicateTarget>(block(blocks[i]).sequenceNumber->range, number)
            .note(block(blocks[0]).sequenceNumber->range, "the first");
    }
  }

  void intoLoop(std::size_t from, const Goto& jump, std::size_t target) {
    for (const Loop& loop : loops_) {
      if (loop.end == kNone) continue;
      const auto inside = [&](std::size_t at) { return at > loop.begin && at <= loop.end; };
      if (!inside(target) || inside(from)) continue;
      context_.report<diag::JumpIntoLoop>(jump.target->range, *numberOf(jump))
          .note(loopAt(loop.begin).range, "the loop");
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
    if (incomplete_ || computed_)
      for (const auto& [number, blocks] : numbered_)
        for (const std::size_t at : blocks)
          reach(at);
    while (!work.empty()) {
      const std::size_t at = work.back();
      work.pop_back();
      const bool always = std::holds_alternative<Goto>(block(at).body) && !block(at).blockDelete;
      if (const Goto* jump = gotoOf(block(at)))
        if (const auto number = numberOf(*jump)) reach(targetOf(at, *number));
      if (!always) reach(at + 1);
    }
    for (std::size_t at = 0; at < count;) {
      if (reached[at]) {
        ++at;
        continue;
      }
      std::size_t behind = at;
      std::size_t first = kNone;
      for (; behind < count && !reached[behind]; ++behind)
        if (first == kNone && doesSomething(block(behind))) first = behind;
      if (first != kNone && at > 0)
        context_
            .report<diag::BlockNeverRuns>(block(first).range, behind < count ? "up to " + nameOf(behind)
                                                                             : "to the end of the program")
            .note(block(at - 1).range, "the jump before it");
      at = behind;
    }
  }

  std::string nameOf(std::size_t at) const {
    if (block(at).sequenceNumber) return "N" + block(at).sequenceNumber->digits;
    return fmt::format("line {}", context_.sources.line(block(at).range));
  }

  // A comment or the END of a loop that is left by jumps alone.
  static bool doesSomething(const Block& one) {
    return !std::holds_alternative<std::monostate>(one.body) && !std::holds_alternative<End>(one.body);
  }

  const Program& program_;
  const CheckContext& context_;
  std::vector<Loop> loops_;
  std::map<std::uint64_t, std::vector<std::size_t>> numbered_;
  bool computed_ = false;   // a jump goes to a computed number
  bool incomplete_ = false; // a jump goes nowhere, or was not read
};

} // namespace

std::vector<Loop> loopsOf(const Program& program) {
  return LoopPairs(program).run(nullptr);
}

void checkFlow(const Program& program, const CheckContext& context) {
  FlowCheck(program, context).run();
}

} // namespace dotek::frontend::macrob
