// What is known of the machine while a program is written. Private to Program*.cpp.
#pragma once

#include "stdlib/Control.h"
#include "support/Source.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace dotek::backends::mikroprog {

inline constexpr std::string_view kProgramAxes = "XYZ";

// What a subprogram finds in force beside the place of the tool; nothing: not known.
struct Inherited {
  std::optional<stdlib::Function> plane = stdlib::Function::PlaneXY;
  std::optional<bool> perRevolution = false;
  std::optional<double> speed = {};
  std::optional<std::uint32_t> tool = {}; // that T has named last, in the spindle or to come
  bool lengthOn = false;
  bool feedLost = false; // the F in force is in no move that is written, or of the other unit

  bool operator==(const Inherited&) const = default;

  // Called from several places.
  Inherited with(const Inherited& other) const {
    Inherited out = *this;
    if (plane != other.plane) out.plane.reset();
    if (perRevolution != other.perRevolution) out.perRevolution.reset();
    if (speed != other.speed) out.speed.reset();
    if (tool != other.tool) out.tool.reset();
    out.lengthOn = lengthOn || other.lengthOn;
    out.feedLost = feedLost || other.feedLost;
    return out;
  }
};

struct ProgramState : Inherited {
  // Where the tool is, as absolute words of the source say it: X of a lathe is a diameter.
  std::array<std::optional<double>, 3> at = {};
  std::optional<stdlib::Function> motion = {};
  std::optional<bool> incremental = false;
  std::optional<double> feed = {}; // in force in the source, and not yet written
  SourceRange feedRange;
  std::array<std::optional<double>, 3> cycleEnd = {}; // of the single cycle in force
  double cycleTaper = 0;
  std::string refusedMotion; // modal code that has no counterpart, and is in force
  bool inThread = false;     // the move before is a pass of a thread

  // After a subprogram, and at its beginning.
  void forget() {
    at = {};
    motion.reset();
    incremental.reset();
    cycleEnd = {};
    refusedMotion.clear();
    inThread = false;
    feed.reset();
  }
};

} // namespace dotek::backends::mikroprog
