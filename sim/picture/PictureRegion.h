// Which part of the machine's space a picture shows, and where it cuts the part.
#pragma once

#include "sim/picture/Picture.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
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

// The work coordinates in which most was measured: where in the machine's space the tip of the probe (without
// a probe: the gauge line) is at their zero. Nothing: they are not known.
struct WorkZero {
  std::string name;
  Point3 at;
};
std::optional<WorkZero> workZeroOf(const Picture& picture);

// The miss with which the search of a run ended: its last measuring move met nothing. Place in
// Picture::errors.
std::optional<std::size_t> lastMissOf(const Picture& picture);

// Where the sections lie: X of YZ, Y of XZ, Z of XY. Where the last search met nothing, through the ball at
// its end, or just inside the face that is nearest there. Else at a contact that the plane cuts from the
// side, so that the touched surface is seen; else just after a touched face, or between two touched from both
// sides; else in the middle of the path, or of the part where there is no material.
struct SectionPlanes {
  std::array<double, 3> at{};                          // by axis
  std::array<std::optional<std::size_t>, 3> contact{}; // that it goes through, place in Picture::contacts
  std::array<std::optional<std::size_t>, 3> miss{};    // the same in Picture::errors
};
SectionPlanes sectionPlanesOf(const Picture& picture, const Region& region);

} // namespace dotek::sim
