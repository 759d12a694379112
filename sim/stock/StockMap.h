// Material as heights over a grid: what tools leave of a block that they cut from above. Lengths in mm, in
// the frame of the stock; the tool points along -Z.
#pragma once

#include "sim/geometry/Point.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace dotek::sim {

// A turning tool seen from the side: flat below within diameter/2 - corner, then rounded by `corner`, then
// straight up without end. A ball has half its diameter as corner.
struct CutterShape {
  double diameter = 0, corner = 0;

  double radius() const { return diameter / 2; }
  // Of its lower side above its tip, at this distance from its axis; the distance is at most the radius.
  double bottom(double distance) const;
};

struct StockBlock {
  Point3 least, most;
  double cell = 1; // side of a square of the grid
};

class StockMap {
public:
  static constexpr std::uint64_t kMostCells = 4'000'000;

  explicit StockMap(const StockBlock& block); // of no more than kMostCells

  std::size_t columns() const { return columns_; }
  std::size_t rows() const { return rows_; }
  const StockBlock& block() const { return block_; }
  // The middle of a cell.
  double x(std::size_t column) const {
    return block_.least.x + (static_cast<double>(column) + 0.5) * block_.cell;
  }
  double y(std::size_t row) const { return block_.least.y + (static_cast<double>(row) + 0.5) * block_.cell; }
  // Exact at the middle; at the least Z of the block nothing is left.
  double height(std::size_t column, std::size_t row) const { return heights_[row * columns_ + column]; }

  struct Cut {
    double deepest = 0; // of what was taken away, along Z; 0: nothing was
    Point3 at;          // its new surface
  };
  // Takes away what the tool passes through as its tip goes straight from one point to the other.
  Cut cut(const CutterShape& tool, const Point3& from, const Point3& to);

  double removed() const { return removed_; } // mm3

private:
  StockBlock block_;
  std::size_t columns_, rows_;
  std::vector<double> heights_;
  double removed_ = 0;
};

} // namespace dotek::sim
