// Who wants to know of every motion of the machine.
#pragma once

#include "sim/Trace.h"

#include <cstdint>

namespace dotek::sim {

enum class MotionKind : std::uint8_t { Rapid, Feed, Skip };

// A straight motion of the machine, tool length included; an arc comes as chords.
struct MachineMotion {
  MotionKind kind = MotionKind::Feed;
  Position from, to;      // of the machine
  std::uint64_t line = 0; // of the program; 0: not known
};

class MotionWatcher {
public:
  virtual ~MotionWatcher() = default;
  virtual void moved(const MachineMotion& motion) = 0;
};

} // namespace dotek::sim
