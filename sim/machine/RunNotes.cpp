// What a run notes of reads and writes, for those who watch it.
#include "sim/machine/Run.h"
#include "sim/machine/Value.h"

namespace dotek::sim {

SourceRange Run::lastWrite(std::uint32_t number) const {
  const std::uint32_t cell = machine_.layout().cellOf(number);
  if (cell >= lastWrites_.size() || lastWrites_[cell] == kNoCell) return {};
  return code_.statementOf(lastWrites_[cell]).origin.range();
}

void Run::noteUnset(std::uint32_t number) {
  if (unset_.erase(number) != 0) unsetReads_.push_back({code_.statementOf(place_).origin.range(), number});
}

void Run::tellRead(std::uint32_t number, double value) {
  const std::uint32_t cell = machine_.layout().cellOf(number);
  if (cell != CellLayout::kNone)
    tellMeasured(cell);
  else if (number != 0)
    listener_->systemRead(number, value);
}

void Run::tellMeasured(std::uint32_t cell) {
  if (!measured_.empty() && measured_.contains(cell))
    listener_->measuredRead(machine_.layout().numberOf(cell), cells_[cell]);
}

void Run::takeMeasured() {
  for (const std::uint32_t number : machine_.takeMeasured()) {
    noteWritten(machine_.layout().cellOf(number));
    if (listener_ == nullptr) continue;
    const std::uint32_t cell = machine_.layout().cellOf(number);
    if (cell != CellLayout::kNone && cell > machine_.layout().locals()) measured_.insert(cell);
    listener_->measuredWritten(number);
  }
}

void Run::tellWritten(std::uint32_t number, double value) {
  if (machine_.layout().cellOf(number) == CellLayout::kNone)
    listener_->systemWritten(number, nullAsZero(value));
}

void Run::noteWrite(std::uint32_t number) {
  if (readEarly_[place_] || !machine_.movesPositions(number)) return;
  readEarly_[place_] = true;
  earlyWrites_.push_back({code_.statementOf(place_).origin.range(), number});
}

} // namespace dotek::sim
