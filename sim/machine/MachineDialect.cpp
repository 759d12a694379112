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
