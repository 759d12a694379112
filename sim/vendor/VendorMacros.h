// The macros of a vendor's pack by their meaning: a call probes and sets what its signature says
// (docs/vendor-macros.md). Whatever no source tells ends the run as inconclusive, naming the macro.
#pragma once

#include "ir/Cycle.h"
#include "sim/machine/MacroMeaning.h"
#include "stdlib/Control.h"
#include "stdlib/MacroSet.h"

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace dotek::sim {

// The cycles that say what calls measure, by the names of stdlib::libraryCycle() and islandCycle().
using MeasuringCycles = std::map<std::string, ir::Cycle, std::less<>>;

// What one run remembers between calls.
struct VendorMemory {
  std::optional<double> stylusRadius; // of a calibrated stylus, mm, where the set's variables do not hold it
  std::set<std::string> said;         // remarks that appear once in a trace
  bool passUnstated = false;
  std::uint32_t measured = 0; // calls that measure, so far
  bool touchesApart = false;
  std::vector<bool> results; // by variable: what calls leave that measure, once it is asked for
};

class VendorMacros final : public MacroMeaning {
public:
  // All outlive the object. One object serves one run.
  VendorMacros(const stdlib::MacroSet& set, const stdlib::Control& control, const MeasuringCycles& cycles)
      : set_(set), control_(control), cycles_(cycles) {}

  // The radius, mm, that the calibration of the stylus would have found. Without it, and with empty variables
  // of the calibration, the macros count with 0 as on a machine that was never calibrated.
  void setStylusRadius(double radius) { memory_.stylusRadius = radius; }

  // A call whose work no source states is passed over, as MotionWatcher::callUnstated says, instead of ending
  // the run: the probe stays where it is. What no source says of the variables that a call leaves is a number
  // that depends on the call's place among those that measure and on the variable; a protected move leaves
  // them alone. For comparing programs that make the same calls.
  void passUnstated() { memory_.passUnstated = true; }

  // A corner is touched face by face, each with what it sets and from the coordinates in which the call
  // began.
  void touchApart() { memory_.touchesApart = true; }

  bool knows(std::uint32_t program) const override { return set_.calls(program); }
  bool run(Machine& machine, std::uint32_t program, std::span<const double> locals) override;

private:
  bool runApart(Machine& machine, const stdlib::MacroSignature& signature, std::span<const double> locals);

  const stdlib::MacroSet& set_;
  const stdlib::Control& control_;
  const MeasuringCycles& cycles_;
  VendorMemory memory_;
};

} // namespace dotek::sim
