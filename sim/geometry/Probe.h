// The probe and the travel of a machine, and the TOML file that states them; docs/part.md. Lengths in mm.
#pragma once

#include "sim/geometry/Devices.h"
#include "stdlib/Setup.h"
#include "support/Diagnostics.h"
#include "support/Limits.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>

namespace dotek::sim {

struct Probe {
  double ballDiameter = 6;
  double effectiveRadius = 3; // of the ball whose touch gives the signal; at most half the ball's diameter
  double length = 0;          // from the gauge line of the spindle
  bool lengthToTip = true;    // down to the lowest point of the ball; else to its centre
  double stemDiameter = 0, stemLength = 0; // 0: none; from the ball's centre up
  double bodyDiameter = 0, bodyLength = 0; // 0: none; from the upper end of the stem up
  double preTravel = 0;                    // way from the touch to the signal
  double overtravel = 0;                   // how far the stylus may be pushed; 0: not at all
  double noise = 0; // standard deviation of the path to the signal, cut off at three times
  std::uint64_t seed = 1;
  bool on = true; // at the start of the program

  double ballRadius() const { return ballDiameter / 2; }
  // From the gauge line down to the ball's centre.
  double centreLength() const { return lengthToTip ? length - ballRadius() : length; }
};

struct MachineLimits {
  struct Span {
    double least = 0, most = 0;
  };
  std::array<std::optional<Span>, 3> travel; // X, Y, Z in coordinates of the machine; nothing: not checked

  // The end of the travel that `place` lies beyond; nothing: it lies within.
  std::optional<double> endBefore(std::size_t axis, double place) const {
    constexpr double kNear = 1e-9; // what sums of coordinates leave
    if (!travel[axis]) return std::nullopt;
    const auto [least, most] = *travel[axis];
    if (place < least - kNear) return least;
    return place > most + kNear ? std::optional(most) : std::nullopt;
  }
};

struct MachineFile {
  std::array<double, 3> start{}; // where X, Y, Z are before the program, in coordinates of the machine
  MachineLimits limits;
  Probe probe;
  bool hasProbe = true; // false: no probe move runs, and nothing is touched
  stdlib::Setup setup;
  Devices devices;
};

// Nothing where an error was reported.
std::optional<MachineFile> readMachine(FileId file, const SourceMap& sources, Diagnostics& diagnostics);
std::optional<MachineFile> loadMachine(const std::string& path, const Limits& limits, SourceMap& sources,
                                       Diagnostics& diagnostics);

} // namespace dotek::sim
