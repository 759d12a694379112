// Where pictures ask for the distance of a part: lines along the axes of the machine, closer where the part
// has small shapes.
#pragma once

#include "sim/picture/PictureRegion.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace dotek::sim {

struct Lattice {
  // By axis, from one side of the region to the other, mm; across a section: the place of the section alone.
  std::array<std::vector<double>, 3> lines;
  // The thickest shape of the part for which they are too far apart, mm: it may be drawn wrong or not at
  // all. 0: there is none. Details of meshes are not known.
  double missed = 0;

  double finest() const; // least distance of two lines
};

// Of the whole region; steps are a `cells`th of its longest side where no shape asks for finer ones. The
// number of cells is bounded, and less for parts of many shapes.
Lattice surfaceLattice(const Part& part, const Region& region, std::uint32_t cells);

// Of the plane where the coordinate `across` (0, 1, 2: X, Y, Z) is `at`.
Lattice sectionLattice(const Part& part, std::size_t across, double at, const Region& region);

// What a picture says of Lattice::missed; "": nothing is.
std::string missedNote(double missed);

} // namespace dotek::sim
