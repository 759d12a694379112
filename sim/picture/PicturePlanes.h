// What a picture is to show first: where the run failed, and where the sections of the part lie.
#pragma once

#include "sim/picture/PictureRegion.h"

#include <array>
#include <cstddef>
#include <optional>

namespace dotek::sim {

// The miss with which the search of a run ended: its last measuring move met nothing. Place in
// Picture::errors.
std::optional<std::size_t> lastMissOf(const Picture& picture);

// The error that a picture is about: that of the banner; else the miss with which the search ended, or that
// an alarm came after. Place in Picture::errors; nothing: none of them has a place.
std::optional<std::size_t> failureOf(const Picture& picture);

// Where ball, stem or body of the probe is against the part, or nearest within it, while the ball is at an
// error; nothing: none of them is.
std::optional<Part::Nearest> touchAt(const Picture& picture, const PictureError& error);

// Where the sections lie: X of YZ, Y of XZ, Z of XY. Where a run failed, through the place where the probe
// met the part, or just inside the face that the plane would be beside; where it met nothing, through the
// ball, or just inside the face that is nearest there. Else at a contact that the plane cuts from the side,
// so that the touched surface is seen; else just after a touched face, or between two touched from both
// sides; else in the middle of the path, or of the part where there is no material.
struct SectionPlanes {
  std::array<double, 3> at{};                          // by axis
  std::array<std::optional<std::size_t>, 3> contact{}; // that it goes through, place in Picture::contacts
  std::array<std::optional<std::size_t>, 3> error{};   // the same in Picture::errors
  std::array<std::optional<std::size_t>, 3> beside{};  // the error whose face it lies just inside of
};
SectionPlanes sectionPlanesOf(const Picture& picture, const Region& region);

} // namespace dotek::sim
