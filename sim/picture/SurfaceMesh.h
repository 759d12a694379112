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
};

// Of the part within the region; where the region cuts it, the surface is open. Edges and corners of the part
// are kept. What is finer than a `cells`th of the region's longest side may be missed. The work is bounded:
// fewer cells are taken for parts of many shapes.
SurfaceMesh surfaceOf(const Part& part, const Region& region, std::uint32_t cells = 112);

} // namespace dotek::sim
