// A part cut by a plane, as lines. Found by its distances alone, so that every kind of shape and mesh is cut
// alike.
#pragma once

#include "sim/picture/PictureRegion.h"

#include <array>
#include <cstddef>
#include <vector>

namespace dotek::sim {

// In the plane: X and Y of a cut across Z, X and Z across Y, Y and Z across X.
using PlanePoint = std::array<double, 2>;
std::array<std::size_t, 2> planeAxes(std::size_t across);

struct SectionLine {
  std::vector<PlanePoint> points; // of a closed one the first is not repeated
  bool closed = false;
};

struct Section {
  std::vector<SectionLine> areas; // closed; material lies to the left, so holes run clockwise
  std::vector<SectionLine> lines; // the same without the borders of the region
};

// The plane where the coordinate `across` (0, 1, 2: X, Y, Z) is `at`, within the region. Lines lie within
// about a twenty-thousandth of the region's longest side of the surface, corners too. On the lattice of
// sectionLattice(), and so the work is bounded.
Section sectionOf(const Part& part, std::size_t across, double at, const Region& region);

} // namespace dotek::sim
