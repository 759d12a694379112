// The meaning of a cycle: runs its IR, statement by statement, with a probe on the virtual machine
// (docs/cycles.md, "What a cycle does"). What the back ends write is compared with it.
#pragma once

#include "ir/Cycle.h"
#include "ir/CycleNames.h"
#include "ir/Evaluate.h"
#include "sim/geometry/Point.h"
#include "sim/geometry/Probe.h"
#include "sim/machine/Machine.h"
#include "stdlib/MacroSet.h"
#include "support/Limits.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dotek::sim {

// What a run is given. Lengths in mm.
struct CycleInputs {
  // By variable of the cycle: parameters and host inputs; null: left out by the caller. One that is not there
  // is not known, and the run ends where it is read.
  ir::Environment values;
  double ballRadius = 3;   // of the stylus: its lowest point lies so far below the centre
  double stylusRadius = 3; // that the calibration found: taken off each measured point along X and Y
  std::optional<double> stylusRadiusY;           // where it found another one along Y
  double overtravel = 10;                        // how far a search goes on after the expected contact
  double approachFeed = 500, measuringFeed = 50; // mm/min
  // Between the two touches of one search; nothing: the second one begins where the first did.
  std::optional<double> backOff = 0.5;
  double tipLength = 0;          // from the gauge line of the spindle down to the lowest point of the ball
  std::optional<double> retract; // Z of the retract plane, active work system; nothing: not known

  // Of the probe: the ball, the radius that the calibration of the stylus would have found, the length.
  void take(const Probe& probe);
};

// A surface that a touch expects: where, in coordinates of the machine, and the direction of the touch.
struct ExpectedSurface {
  Point3 point;
  Point3 direction; // length 1
  SourceRange range;
  double distance =
      0;           // to the surface from where the touch begins: the ball's centre, downward its lowest point
  double ball = 0; // from there to what of the ball touches, mm; not less than `distance`: in contact at once
};

// The way that a run takes through the body of its cycle.
struct CycleWay {
  std::vector<bool> reached; // by statement
  std::uint64_t turns = 0;   // the same where the same statements ran in the same order
};

// Who runs a cycle as the meaning of one statement, and answers for its end: the run is ended by these.
class CycleCaller {
public:
  virtual ~CycleCaller() = default;
  virtual bool alarm(stdlib::MacroAlarm kind) = 0; // false
  virtual bool refused(std::string_view why) = 0;  // by a check of the cycle, or as having no meaning; false
};

class CycleRun final : private ir::Readings {
public:
  // All outlive the run; the machine holds the length of the probe's tool (Machine::holdTool). `nominal`:
  // each touch finds its surface where it is expected, and nothing else is in the way; no part is asked.
  CycleRun(Machine& machine, const ir::Cycle& cycle, CycleInputs inputs, const Limits& limits,
           bool nominal = false);

  // Before run(): it notes its way. It outlives the run.
  void follow(CycleWay& way);
  // The checks, then the body: Machine::end() says how it came.
  void run();
  // The same within a program that goes on afterwards; its watcher hears of the motions alone. false: the run
  // has ended.
  bool runFor(CycleCaller& caller);

  // The statement that runs, or at which the run ended; nullptr: none has begun.
  const ir::CycleStatement* statement() const { return at_; }
  SourceRange place() const;
  // Of calls that are open, the outermost first.
  std::vector<SourceRange> openCalls() const;
  // The move that runs is to meet nothing.
  bool isProtected() const { return protected_; }
  // Of an alarm that the run itself raised: what all probing macros call the same.
  std::optional<stdlib::MacroAlarm> alarmKind() const { return alarmKind_; }
  const ir::Scalar& value(ir::VariableId id) const { return inputs_.values[id]; }
  // What the cycle leaves its caller, by the names of its results; empty where it did not come to its end.
  const std::vector<std::pair<std::string, double>>& left() const { return left_; }
  // Surfaces that the touches expected, in the order of the run; at most kMostExpected.
  static constexpr std::size_t kMostExpected = 10'000;
  const std::vector<ExpectedSurface>& expected() const { return expected_; }

private:
  static constexpr double kMostTool = 999;
  using Direction = std::array<double, 3>; // length 1

  // ---- CycleRun.cpp
  bool runAll();
  bool runList(const std::vector<ir::CycleStatement>& list);
  bool step(const ir::CycleStatement& statement);
  bool spend(std::uint64_t steps);
  bool inconclusive(std::string why);
  bool alarm(stdlib::MacroAlarm kind);
  bool raise(std::string_view text); // of what is wrong with the values; false
  MotionWatcher* watcher() const { return caller_ == nullptr ? machine_.watcher() : nullptr; }
  bool assign(const ir::Assign& node);
  bool store(const ir::Store& node);
  bool setMode(const ir::SetMode& node);
  void fillHosts();
  // The value; nothing: the run has ended.
  std::optional<double> number(const ir::ExpressionPtr& expression);
  std::optional<bool> decide(const ir::ConditionPtr& condition);
  std::optional<Machine::WorkSystem> system(const ir::ExpressionPtr& expression);
  ir::Scalar result(ir::ResultName name) const override;
  ir::Scalar machineVariable(double number) const override;

  // ---- CycleMove.cpp
  bool move(const ir::Move& node);
  // Where the lowest point of the ball gets along the axis, in the active system.
  std::optional<double> coordinate(const ir::Coordinate& target, std::size_t axis, ir::ProbePoint point);
  double shift(std::size_t axis) const; // from the active system to the machine, the tool's length included
  bool goTo(const Position& end, MotionKind kind, std::optional<double> feed = std::nullopt);
  bool protectedTo(const Position& end); // contact is an alarm; without the watcher's notice

  // ---- CycleCalls.cpp: what the language has beside moves and plain touches (ir/CycleNames.h)
  bool call(const ir::CallCycle& node);
  // The argument; nothing: there is none. false: the run has ended.
  bool read(const ir::CallCycle& node, std::string_view name, std::optional<double>& value);
  bool callSurface(const ir::CallCycle& node);
  bool callSurfaceAlong(const ir::CallCycle& node);
  bool setOffset(const ir::CallCycle& node);
  bool setTool(const ir::CallCycle& node);
  double toolValue(std::uint32_t tool, ir::ToolPart part) const;
  // A length or radius as a whole leaves no wear.
  bool writeTool(std::uint32_t tool, ir::ToolPart part, double value);
  // false: there is no such offset, and the run has ended.
  bool hasTool(std::optional<double> tool);
  bool report(const ir::CallCycle& node);

  // ---- CycleTouch.cpp
  struct Touched {
    Position at{};      // of the lowest point, active system
    bool found = false; // else the run goes on, with the probe where the touch began
  };
  struct Search {
    double overtravel = 0;
    bool stated = false;  // the statement's own
    bool once = false;    // a single touch
    bool mayMiss = false; // that it finds nothing is foreseen
  };
  bool measure(const ir::Measure& node);
  bool surface(const ir::Measure& node);
  bool bore(const ir::Measure& node);
  Search usualSearch() const { return {inputs_.overtravel, false, false, false}; }
  // Along an axis, between begin() and end(); nothing: it was not found, and that was foreseen.
  bool touchAxis(std::size_t axis, double expected, const Search& search, std::optional<double>& measured);
  // From where the probe is; it is back afterwards.
  bool touch(const PlannedTouch& planned, const Search& search, Touched& touched);
  bool search(const Direction& direction, double travel, const Search& how, Touched& touched);
  bool notFound();
  // From where the probe is.
  PlannedTouch plan(const Direction& direction, double distance, const Search& search) const;
  void begin(std::span<const PlannedTouch> touches);
  void end();
  double calibrated(std::size_t axis) const { // radius, mm
    return axis == 1 ? inputs_.stylusRadiusY.value_or(inputs_.stylusRadius) : inputs_.stylusRadius;
  }
  double ballAlong(const PlannedTouch& planned) const; // from its centre, or lowest point, to the contact
  // From the place that `touched` gives to the surface, along the axis.
  double surfaceFrom(std::size_t axis, double sign) const;
  bool set(const ir::OffsetSetting& setting, const std::array<std::optional<double>, 3>& measured);

  Machine& machine_;
  const ir::Cycle& cycle_;
  CycleInputs inputs_;
  const bool nominal_;
  std::uint64_t fuel_;
  CycleCaller* caller_ = nullptr;
  const ir::CycleStatement* at_ = nullptr;
  CycleWay* way_ = nullptr;
  std::optional<ir::LabelId> jump_; // of the statement that ran
  bool returned_ = false;
  bool protected_ = false;
  std::optional<stdlib::MacroAlarm> alarmKind_;
  Position start_{}; // of the machine, where the cycle began
  std::map<ir::ResultName, double> results_;
  std::string comment_; // the last one
  std::vector<std::pair<std::string, double>> left_;
  std::vector<ExpectedSurface> expected_;
};

} // namespace dotek::sim
