// Which part of the machine's space a picture shows.
#pragma once

#include "sim/picture/Picture.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dotek::sim {

// A box parallel to the axes of the machine, mm.
struct Region {
  Point3 least, most;

  bool contains(const Point3& p) const;
};

// X, Y or Z of a point: 0, 1 or 2.
double coordinate(const Point3& p, std::size_t axis);
void setCoordinate(Point3& p, std::size_t axis, double value);

// Coordinates beyond this (mm) are of no machine: a picture leaves such points out and says so.
inline constexpr double kDrawn = 1e6;
bool isDrawn(const Point3& p);
bool isDrawn(const PictureMove& move);

// Whether the picture has a probe, so that its path is that of the ball's centre.
bool hasProbe(const Picture& picture);

// The box that holds the part. A side without end is at kDrawn or beyond.
Region reachOf(const Part& part);

// What is drawn: the slow moves, contacts and errors, what is near of rapids, and the part: the whole of it,
// unless it is so large that what was measured would be lost in it. A box of at least a few millimetres;
// where nothing can be drawn, one about zero.
Region regionOf(const Picture& picture);
// The sides at which the part goes on beyond the region: "X+", "Z-".
std::vector<std::string> cutSidesOf(const Picture& picture, const Region& region);
// What is to be said of them; "": the part is whole.
std::string cutNote(const Picture& picture, const Region& region);

// The work coordinates in which most was measured. Nothing: they are not known.
struct WorkZero {
  std::string name;
  Point3 at;              // where in the machine's space the tool's point is while the control shows zero
  double above = 0;       // Z of the system counts for a point that much above it: another length is in force
  double length = 0;      // this one, where `above` is not 0
  std::string_view point; // "tip"; "": the gauge line
  Point3 zero() const { return at + Point3{0, 0, above}; } // of the system
};
std::optional<WorkZero> workZeroOf(const Picture& picture);

} // namespace dotek::sim
