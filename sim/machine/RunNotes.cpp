// What a run notes of reads and writes, for those who watch it.
#include "sim/machine/Run.h"
#include "sim/machine/Value.h"

namespace dotek::sim {

void Run::watchWrites(const std::set<std::uint32_t>& numbers) {
  watchedWrites_.assign(machine_.layout().size(), 0);
  for (const std::uint32_t number : numbers) {
    const std::uint32_t cell = machine_.layout().cellOf(number);
    if (cell >= watchedWrites_.size() || watchedWrites_[cell] != 0) continue;
    writes_.emplace_back();
    watchedWrites_[cell] = static_cast<std::uint32_t>(writes_.size());
  }
}

void Run::keepWrite(std::uint32_t cell, bool done) {
  constexpr std::size_t kMost = 64;
  std::vector<Write>& all = writes_[watchedWrites_[cell] - 1];
  if (!all.empty()) all.back().value = done ? kUnknown : cells_[cell];
  if (all.size() < kMost) all.emplace_back();
  all.back().place = place_;
}

std::vector<Run::Written> Run::writesOf(std::uint32_t number) const {
  std::vector<Written> out;
  const std::uint32_t cell = machine_.layout().cellOf(number);
  if (cell >= watchedWrites_.size() || watchedWrites_[cell] == 0) return out;
  for (const Write& write : writes_[watchedWrites_[cell] - 1])
    out.push_back({write.value, code_.statementOf(write.place).origin.range()});
  if (!out.empty()) out.back().value = machine_.common(number);
  return out;
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
    noteWritten(machine_.layout().cellOf(number), true);
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
