// One call of a vendor's macro while it runs. Private to sim.
#pragma once

#include "sim/cycle/CycleRun.h"
#include "sim/machine/Machine.h"
#include "sim/vendor/VendorMacros.h"

#include <array>
#include <map>

namespace dotek::sim {

// A direction in the space of X, Y, Z, of length 1.
using Direction = std::array<double, 3>;

class VendorRun final : private CycleCaller {
public:
  VendorRun(Machine& machine, const stdlib::MacroSet& set, const stdlib::Control& control,
            const MeasuringCycles& cycles, const stdlib::MacroSignature& signature,
            std::span<const double> locals, VendorMemory& memory)
      : machine_(machine), set_(set), control_(control), cycles_(cycles), signature_(signature),
        locals_(locals), memory_(memory), start_(machine.position()) {}

  bool run(); // false: the run has ended

private:
  using Role = stdlib::ArgumentRole;
  using Output = stdlib::Output;

  // ---- the call
  const stdlib::MacroArgument* argument(Role role, ir::Axis axis = ir::Axis::X) const; // nullptr: not given
  std::optional<double> value(Role role, ir::Axis axis = ir::Axis::X) const;
  double need(Role role) const { return value(role).value_or(0); } // of one that is required
  bool begin();
  bool notKnown(std::string_view what, char letter = 0);    // false: inconclusive
  bool meaningless(std::string_view what, char letter = 0); // the same, of an argument's value
  bool passes(std::string_view what, char letter = 0);      // true: noted, and passed over
  bool leave();                                             // after a call that is passed over
  bool alarm(stdlib::MacroAlarm alarm) override;            // false
  bool refused(std::string_view why) override;              // by the cycle that says what is measured; false
  void sayOnce(std::string_view action, const std::string& text);
  bool features();

  // ---- touching (VendorTouch.cpp)
  bool findStylus();
  bool radius(const Direction& direction, double& out);
  // From `from`, where the probe is: two touches, and back. The surface is expected `distance` away from
  // the ball's centre; the travel ends `overtravel` beyond, or at `distance` where `plain`. `centre`: the
  // ball's.
  bool touch(const Direction& direction, double distance, Position& centre, bool plain = false);
  double overtravel(const Direction& direction) const;
  static Direction directionAt(double angle); // in the plane, degrees; multiples of 90 are exact

  // ---- features (VendorFeatures.cpp)
  bool protectedMove();
  bool surface();
  bool angledSurface();

  // ---- features that a cycle measures (VendorDefinition.cpp)
  bool defined();
  const ir::Cycle* definition(); // nullptr: there is none, or a value says no way; the run has ended
  void give(const ir::Cycle& cycle, ir::Environment& values) const; // its parameters
  void take(const CycleRun& run);                                   // its results
  bool oblique(); // touches at angles: false: the run has ended

  // ---- what is found
  void foundPosition(ir::Axis axis, double measured, double expected);
  void foundSize(double measured, double expected);

  // ---- what it leaves (VendorUpdate.cpp)
  bool finish();
  bool addExperience();
  bool checkTolerances();
  Measurement foundHere() const;
  std::optional<Machine::WorkSystem> systemGiven() const; // by the call, which names one; nothing: unknown
  bool setSystem();
  bool setTool();
  void writeResults();
  // What no source says that it holds; where what it stands for is stated, a value near that.
  void leaveUnstated(std::uint32_t variable, std::optional<Output> meaning = std::nullopt);
  std::optional<std::uint32_t> offsetVariable(std::uint32_t system, bool extended, ir::Axis axis) const;

  Machine& machine_;
  const stdlib::MacroSet& set_;
  const stdlib::Control& control_;
  const MeasuringCycles& cycles_;
  const stdlib::MacroSignature& signature_;
  std::span<const double> locals_;
  VendorMemory& memory_;
  const Position start_;
  std::optional<double> feed_; // that stays in force; nothing: not known

  bool passed_ = false; // nothing is touched
  bool missed_ = false; // a touch that may find nothing found nothing
  double radiusX_ = 0, radiusY_ = 0;
  bool vectors_ = false; // radii by direction are in force

  std::map<Output, double> found_;
  std::array<std::optional<double>, 3> error_; // by axis: measured - expected
  std::optional<double> size_, expectedSize_, angleError_;
};

} // namespace dotek::sim
