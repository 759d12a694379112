// One call of a vendor's macro while it runs. Private to sim.
#pragma once

#include "sim/machine/Machine.h"
#include "tests/oracle/VendorMacros.h"

#include <array>
#include <map>

namespace dotek::oracle {

using namespace dotek::sim;

// A direction in the space of X, Y, Z, of length 1.
using Direction = std::array<double, 3>;

class VendorRun {
public:
  VendorRun(Machine& machine, const stdlib::MacroSet& set, const stdlib::Control& control,
            const stdlib::MacroSignature& signature, std::span<const double> locals, VendorMemory& memory)
      : machine_(machine), set_(set), control_(control), signature_(signature), locals_(locals),
        memory_(memory), start_(machine.position()) {}

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
  bool alarm(stdlib::MacroAlarm alarm);                     // false
  void sayOnce(std::string_view action, const std::string& text);
  bool features();

  // ---- touching (VendorTouch.cpp)
  bool findStylus();
  bool radius(const Direction& direction, double& out);
  // From `from`, where the probe is: two touches, and back. The surface is expected `distance` away from
  // the ball's centre; the travel ends `overtravel` beyond, or at `distance` where `plain`. `centre`: the
  // ball's.
  bool touch(const Direction& direction, double distance, Position& centre, bool plain = false);
  bool watched(const Position& end); // contact on the path is an alarm
  double overtravel(const Direction& direction) const;
  // Touches the feature on the side `direction` of its middle, as far away as `half`, inside, or from outside
  // and down to the depth.
  bool touchSide(const Position& middle, const Direction& direction, double half, Position& centre);
  // Both sides; `offset`: of the true middle along the direction.
  bool touchPair(const Position& middle, const Direction& direction, double width, double& offset,
                 double& size);
  bool findSides();

  // ---- features (VendorFeatures.cpp)
  bool protectedMove();
  bool surface();
  bool round();
  bool flat();
  bool innerCorner();
  bool faceAngle();
  bool angledSurface();
  bool angledFlat();
  bool threePoints();
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
  const stdlib::MacroSignature& signature_;
  std::span<const double> locals_;
  VendorMemory& memory_;
  const Position start_;
  std::optional<double> feed_; // that stays in force; nothing: not known

  bool passed_ = false; // nothing is touched
  bool missed_ = false; // a touch that may find nothing found nothing
  double radiusX_ = 0, radiusY_ = 0;
  bool vectors_ = false; // radii by direction are in force
  // How a width or a diameter is touched: from within at the height of the start; or beside the feature, down
  // to the depth, `beside_` away from its surface, inward where `outside_`.
  bool down_ = false, outside_ = false;
  double beside_ = 0, depth_ = 0;

  std::map<Output, double> found_;
  std::array<std::optional<double>, 3> error_; // by axis: measured - expected
  std::optional<double> size_, expectedSize_, angleError_;
};

} // namespace dotek::oracle
