// What is known of the machine while a program is written. Private to Program*.cpp.
#pragma once

#include "stdlib/Control.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace dotek::backends::mikroprog {

inline constexpr std::string_view kProgramAxes = "XYZ";

struct ProgramState {
  // Where the tool is, as absolute words of the source say it: X of a lathe is a diameter.
  std::array<std::optional<double>, 3> at = {};
  std::optional<stdlib::Function> motion = {};
  stdlib::Function plane = stdlib::Function::PlaneXY;
  std::optional<bool> incremental = false, perRevolution = false;
  std::optional<double> speed = {};
  std::optional<double> feed = {};        // in force in the source, and not yet written
  std::optional<std::uint32_t> tool = {}; // that T has named last, in the spindle or to come
  bool lengthOn = false, systemSaid = false;
  std::array<std::optional<double>, 3> cycleEnd = {}; // of the single cycle in force
  double cycleTaper = 0;

  // After a subprogram, and at its beginning.
  void forget() {
    at = {};
    motion.reset();
    incremental.reset();
    cycleEnd = {};
  }
};

} // namespace dotek::backends::mikroprog
