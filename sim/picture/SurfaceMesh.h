// The surface of a part as triangles, for pictures. Found by its distances alone, so that every kind of
// shape and mesh is drawn alike.
#pragma once

#include "sim/picture/PictureRegion.h"

#include <array>
#include <cstdint>
#include <vector>

namespace dotek::sim {

struct SurfaceMesh {
  std::vector<Point3> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles; // counterclockwise as seen from outside
  double missed = 0;                                   // as Lattice::missed
};

// Of the part within the region; where the region cuts it, the surface is open. Edges and corners of the part
// are kept. On the lattice of surfaceLattice(), and so the work is bounded.
SurfaceMesh surfaceOf(const Part& part, const Region& region, std::uint32_t cells = 112);

} // namespace dotek::sim
