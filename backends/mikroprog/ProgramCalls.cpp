// Subprograms: called by G26, or written in place of their calls.
#include "backends/mikroprog/ProgramWriter.h"

#include "ir/Match.h"
#include "stdlib/CalledProgram.h"
#include "support/messages/Mikroprog.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace dotek::backends::mikroprog {

using stdlib::Function;

namespace {

constexpr double kMostRepeats = 50;
constexpr std::size_t kMostInPlace = 100'000; // blocks
constexpr std::size_t kMostDepth = 8;         // of calls in place

} // namespace

void ProgramWriter::call(const ir::Call& call, SourceRange range) {
  constexpr double kMostProgram = 99'999'999;
  const double* const number = call.program ? ir::constantValue(call.program) : nullptr;
  stdlib::SubprogramCall which{0, 1};
  if (number != nullptr && *number >= 1 && *number <= kMostProgram && *number == std::floor(*number)) {
    which.program = static_cast<std::uint64_t>(*number);
    if (!call.repeats) which = stdlib::subprogramCall(which.program, source_);
  }
  const double repeats = !call.repeats                     ? which.times
                         : ir::constantValue(call.repeats) ? *ir::constantValue(call.repeats)
                                                           : 0;
  callRefused_ = true; // until it is written
  if (call.kind != ir::CallKind::Subprogram || number == nullptr)
    return cannot(range, "programs take no arguments here",
                  "`--var N=VALUE` runs the program, and writes the blocks of the run");
  const auto program =
      std::find_if(file_.programs.begin(), file_.programs.end(),
                   [&](const ir::Program& one) { return one.number == which.program && one.number != 0; });
  if (program == file_.programs.end() || program == file_.programs.begin())
    return cannot(range, fmt::format("O{:04} is no subprogram of this file", which.program),
                  "write it below the program that calls it");
  if (!(repeats >= 1 && repeats <= kMostRepeats))
    return cannot(range, "how often H of G26 repeats is not stated (Q8), so repeats are written as calls",
                  fmt::format("call it at most {} times", kMostRepeats));
  if (goesByWays(*program)) return callInPlace(*program, static_cast<int>(repeats), range);
  Inherited now = state_;
  now.feedLost = now.feedLost || state_.feed;
  const auto [found, first] = inherited_.emplace(program->number, now);
  const Inherited both = found->second.with(now);
  if (written_.contains(program->number) && both != found->second)
    return cannot(range, "the subprogram is called here with another plane, feed, speed or tool than before",
                  "say them in the subprogram, or call it from one place");
  found->second = both;
  callRefused_ = false;
  const auto [mark, added] = marks_.emplace(program->number, static_cast<Mark>(marks_.size()));
  if (added) called_.push_back(&*program);
  for (int i = 0; i < static_cast<int>(repeats); ++i)
    sheet_->jump("G26", mark->second, "", origin_, std::exchange(comment_, ""));
  const Leaves& left = leaves();
  const auto sets = [&](Function one) { return left.modes.contains(one); };
  for (const Function plane : {Function::PlaneXY, Function::PlaneZX, Function::PlaneYZ})
    if (sets(plane) && state_.plane != plane) state_.plane.reset();
  if (sets(Function::FeedPerMinute) && state_.perRevolution != false) state_.perRevolution.reset();
  if (sets(Function::FeedPerRevolution) && state_.perRevolution != true) state_.perRevolution.reset();
  if (left.speed) state_.speed.reset();
  if (left.tool) state_.tool.reset(), state_.lengthOn = true;
  state_.feedLost = now.feedLost || left.feed;
  forget();
}

bool ProgramWriter::goesByWays(const ir::Program& program) const {
  for (const ir::ProgramStatement& statement : program.body) {
    const auto* const block = std::get_if<ir::NcBlock>(&statement.node);
    if (block == nullptr) continue;
    bool ways = false, other = false;
    for (const ir::Word& word : block->words) {
      const stdlib::CodeInfo* const code = word.address == 'G' ? codeOf(word) : nullptr;
      if (source_.turning) {
        ways = ways || std::string_view("UVW").find(word.address) != std::string_view::npos;
        other = other || (code != nullptr &&
                          (code->function == Function::ReferenceReturn || code->function == Function::Dwell));
      } else {
        ways = ways || (code != nullptr && code->function == Function::Incremental);
      }
    }
    if (ways && !other) return true;
  }
  return false;
}

void ProgramWriter::callInPlace(const ir::Program& program, int times, SourceRange range) {
  inPlace_.insert(program.number);
  dropped(range, "the call",
          "the subprogram goes by ways from where the tool is, and is written in its place");
  callRefused_ = false;
  if (!comment_.empty()) sheet_->comment(std::exchange(comment_, ""), origin_);
  for (int i = 0; i < times && !programEnded_; ++i) {
    blocksInPlace_ += program.body.size();
    if (depth_ >= kMostDepth || blocksInPlace_ > kMostInPlace)
      return cannot(range,
                    "a subprogram with ways is written in place of its call, and this becomes too long",
                    "write absolute coordinates in it");
    ++depth_;
    for (const std::string& title : program.titleComments)
      sheet_->comment(plain(title), {});
    body(program, true);
    --depth_;
  }
  ended_ = programEnded_;
}

const stdlib::CodeInfo* ProgramWriter::codeOf(const ir::Word& word) const {
  const double* const value = ir::constantValue(word.value);
  if (value == nullptr) return nullptr;
  return source_.find(word.address, static_cast<std::uint32_t>(std::lround(*value * 10)));
}

const ProgramWriter::Leaves& ProgramWriter::leaves() {
  if (leaves_) return *leaves_;
  leaves_.emplace();
  for (std::size_t i = 1; i < file_.programs.size(); ++i)
    for (const ir::ProgramStatement& statement : file_.programs[i].body) {
      const auto* const block = std::get_if<ir::NcBlock>(&statement.node);
      if (block == nullptr) continue;
      bool moves = false, feeds = false;
      for (const ir::Word& word : block->words) {
        leaves_->speed = leaves_->speed || word.address == 'S';
        leaves_->tool = leaves_->tool || word.address == 'T';
        feeds = feeds || word.address == 'F';
        moves = moves || std::string_view("XYZUVW").find(word.address) != std::string_view::npos;
        if (const stdlib::CodeInfo* code = codeOf(word); code != nullptr && word.address == 'G')
          leaves_->modes.insert(code->function);
      }
      leaves_->feed = leaves_->feed || (feeds && !moves);
    }
  // Of a thread F is the pitch, and K here.
  leaves_->feed = leaves_->feed || leaves_->modes.contains(Function::Thread);
  return *leaves_;
}

} // namespace dotek::backends::mikroprog
