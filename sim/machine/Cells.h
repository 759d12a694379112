// Where the variables of macros are in memory: one array, so that a compiled program reads and writes them
// without a search. The locals of the level that runs are in the same cells at every level.
#pragma once

#include "stdlib/Control.h"

#include <cstdint>
#include <vector>

namespace dotek::sim {

class CellLayout {
public:
  static constexpr std::uint32_t kNone = UINT32_MAX;

  explicit CellLayout(const stdlib::Control& control);

  std::uint32_t locals() const { return locals_; } // #1 to this one are in the cells of their numbers
  std::uint32_t size() const { return size_; }     // cell 0 is #0
  // Of a local or a common variable; kNone: it is none.
  std::uint32_t cellOf(std::uint32_t number) const;
  // The variable of a cell below size().
  std::uint32_t numberOf(std::uint32_t cell) const;

private:
  struct Range {
    std::uint32_t first, last, cell;
  };
  std::uint32_t locals_ = 0, size_ = 0;
  std::vector<Range> commons_;
};

} // namespace dotek::sim
