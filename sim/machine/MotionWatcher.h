// Who wants to know of every motion of the machine, and of what else a probe's safety depends on.
#pragma once

#include "sim/machine/Trace.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace dotek::sim {

enum class MotionKind : std::uint8_t { Rapid, Feed, Skip };

// A straight motion of the machine, tool length included; an arc comes as chords. A Skip ends where the
// machine stopped.
struct MachineMotion {
  MotionKind kind = MotionKind::Feed;
  Position from, to;      // of the machine
  std::uint64_t line = 0; // of the program; 0: not known
  bool known = true;      // false: where it began or ended is not certain
};

struct Measurement;
struct OffsetWrite;

class MotionWatcher {
public:
  virtual ~MotionWatcher() = default;
  virtual void moved(const MachineMotion& motion) = 0;
  virtual void probeSwitched(bool /*on*/) {}
  virtual void positionSet() {}                     // G92: the machine is still, its coordinates change
  virtual void paused(std::string_view /*text*/) {} // a stop, and what the operator reads
  // A file that the control writes: where the machine is, or a value.
  virtual void recorded(std::string_view /*file*/, std::optional<double> /*value*/) {}
  virtual void toolChanged(std::uint32_t /*number*/) {} // M6; the tool that T has named
  // G43 or G44 puts the length of an offset in force that nobody has set.
  virtual void lengthNotSet(std::uint32_t /*offset*/) {}
  // A call with arguments (G65 and its like), by text or by meaning: `locals` by number from #0 (unused) on,
  // kNull where there is none. Each call that begins ends, but for those in which the run ends.
  virtual void callBegins(std::uint32_t /*program*/, std::span<const double> /*locals*/) {}
  virtual void callEnded(std::uint32_t /*program*/) {}
  // What a macro that ran by its meaning found, before tolerances are checked and offsets are set.
  virtual void measured(const Measurement& /*found*/) {}
  virtual void offsetWritten(const OffsetWrite& /*write*/) {}
};

} // namespace dotek::sim
