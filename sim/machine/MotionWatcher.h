// Who wants to know of every motion of the machine, and of what else a probe's safety depends on.
#pragma once

#include "sim/machine/Trace.h"

#include <array>
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

// A touch of a cycle (sim/cycle): from where, active work system, and the surface that it expects.
struct PlannedTouch {
  Position from;                     // of the ball's lowest point
  std::array<double, 3> direction{}; // length 1
  double distance = 0;   // of the surface from the ball's centre; straight down from its lowest point
  double overtravel = 0; // of the search, after the expected contact
  bool stated = false;   // the overtravel is one of its own
  bool isDown() const { return direction[2] < 0 && direction[0] == 0 && direction[1] == 0; }
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
  // #3006 = number (text): a stop, which a program of macro B asks for. 0: the number is not known.
  virtual void messaged(double /*number*/, std::string_view /*text*/) {}
  // A file that the control writes: where the machine is, or a value.
  virtual void recorded(std::string_view /*file*/, std::optional<double> /*value*/) {}
  // A program reads where the machine is or its last block has ended; `skip`: where the last skip move has.
  virtual void positionRead(bool /*skip*/) {}
  virtual void toolChanged(std::uint32_t /*number*/) {} // M6; the tool that T has named
  // An M code that moves no axis and changes nothing that the machine keeps: M19; an optional stop.
  virtual void auxiliary(std::uint32_t /*code*/) {}
  virtual void dwelled(double /*seconds*/) {}
  // G43 or G44 puts the length of an offset in force that nobody has set.
  virtual void lengthNotSet(std::uint32_t /*offset*/) {}
  // A call with arguments (G65 and its like), by text or by meaning: `locals` by number from #0 (unused) on,
  // kNull where there is none. Each call that begins ends, but for those in which the run ends.
  virtual void callBegins(std::uint32_t /*program*/, std::span<const double> /*locals*/) {}
  virtual void callEnded(std::uint32_t /*program*/) {}
  // One of the touches of the open call is done, and what it sets is set; VendorMacros::touchApart.
  virtual void touchedApart() {}
  // The call that is open does something that no source states, and the run goes on as if it did nothing.
  virtual void callUnstated(std::string_view /*what*/, std::span<const double> /*locals*/) {}
  // M98 of a program that is not at hand and is taken to do nothing (Run::passOverAbsent).
  virtual void absentCalled(std::uint32_t /*program*/) {}
  // Touches of a cycle that are one measurement, and all that they move and set; and a protected move of a
  // cycle, with its feed where one is stated. Each that begins ends, but for one in which the run ends.
  virtual void touchBegins(std::span<const PlannedTouch> /*touches*/) {}
  virtual void touchEnded() {}
  virtual void protectedBegins(std::optional<double> /*feed*/) {}
  virtual void protectedEnded() {}
  // What a macro that ran by its meaning found, before tolerances are checked and offsets are set.
  virtual void measured(const Measurement& /*found*/) {}
  virtual void reported(const Measurement& /*line*/) {} // of a cycle's protocol
  virtual void offsetWritten(const OffsetWrite& /*write*/) {}
};

} // namespace dotek::sim
