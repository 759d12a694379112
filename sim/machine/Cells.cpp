#include "sim/machine/Cells.h"

namespace dotek::sim {

CellLayout::CellLayout(const stdlib::Control& control) : locals_(control.locals), size_(control.locals + 1) {
  for (const stdlib::VariableRange& range : control.common) {
    commons_.push_back({range.first, range.last, size_});
    size_ += range.last - range.first + 1;
  }
}

std::uint32_t CellLayout::cellOf(std::uint32_t number) const {
  if (number <= locals_) return number == 0 ? kNone : number;
  for (const Range& range : commons_)
    if (number >= range.first && number <= range.last) return range.cell + (number - range.first);
  return kNone;
}

std::uint32_t CellLayout::numberOf(std::uint32_t cell) const {
  for (const Range& range : commons_)
    if (cell >= range.cell && cell - range.cell <= range.last - range.first)
      return range.first + (cell - range.cell);
  return cell;
}

} // namespace dotek::sim
