// What the machine does for some dialects alone.
#include "sim/machine/Axes.h"
#include "sim/machine/Machine.h"

namespace dotek::sim {

void Machine::holdTool(double length) {
  work_[2] = snap(work_[2] + toolLength_ - length);
  toolLength_ = length;
}

void Machine::moveZero(std::size_t axis, double by) {
  Position& system = modes_[kSystem] == kExtended ? extended_[extendedNow_] : systems_[modes_[kSystem]];
  system[axis] = snap(system[axis] + by);
  const Position now = work_;
  updateOffsets();
  work_ = now;
  at_ = machinePosition();
}

void Machine::countBlock(std::uint64_t line) {
  ++blocks_;
  atLine(line);
}

void Machine::atLine(std::uint64_t line) {
  stack_.back().line = line;
  if (trace_ != nullptr) trace_->at(line);
}

void Machine::shiftLocally(const Position& origin) {
  if (local_ == origin) return;
  local_ = origin;
  updateOffsets();
  if (trace_ != nullptr) trace_->begin("local").position(local_, shown_).end();
}

bool Machine::threadTo(const Position& end, double lead) {
  std::uint32_t axes = 0;
  for (std::size_t i = 0; i < kAxes; ++i)
    if (end[i] != work_[i]) axes |= 1u << i;
  work_ = end;
  moved_ = true;
  if (trace_ != nullptr) trace_->begin("thread").position(end, shown_).word("K", lead).end();
  if (watcher_ != nullptr) tellMotion(MotionKind::Feed, axes);
  return running();
}

bool Machine::runToReference(std::uint32_t axes) {
  shift_ = {};
  updateOffsets();
  for (std::size_t i = 0; i < kAxes; ++i)
    if ((axes >> i & 1) != 0) work_[i] = snap(-offset_[i] - (i == 2 ? toolLength_ : 0));
  uncertain_ &= ~axes;
  moved_ = true;
  if (trace_ != nullptr) trace_->begin("reference").position(work_, shown_).end();
  if (watcher_ == nullptr) return true;
  watcher_->positionSet();
  tellMotion(MotionKind::Rapid, axes);
  return running();
}

void Machine::traceRound(std::string_view name, const Position& corner) {
  if (trace_ == nullptr) return;
  trace_->begin("cycle").text(name).position(corner, shown_);
  if (feed_ > 0) trace_->word(modes_[kFeedMode] == 0 ? "F" : "FR", feed_);
  trace_->text("ends").position(work_, shown_).end();
}

std::optional<bool> Machine::signalIsThere() {
  if (skip_ == nullptr) return std::nullopt;
  SkipMove here;
  here.from = here.to = work_;
  here.machineFrom = here.machineTo = machinePosition();
  here.feed = feed_;
  return skip_->isThere(here);
}

void Machine::pause(std::string_view text) {
  if (watcher_ != nullptr) watcher_->paused(text);
  if (trace_ == nullptr) return;
  trace_->begin("stop");
  if (!text.empty()) trace_->text(text);
  trace_->end();
}

void Machine::record(std::string_view file, std::optional<double> value) {
  if (watcher_ != nullptr) watcher_->recorded(file, value);
  if (trace_ == nullptr) return;
  trace_->begin("record").text(file);
  if (value)
    trace_->word("", *value);
  else
    trace_->position(work_, shown_);
  trace_->end();
}

} // namespace dotek::sim
