// A part and a probe in a machine: whether and where the probe signals, and what goes wrong on the path.
#pragma once

#include "sim/geometry/Contact.h"
#include "sim/geometry/Devices.h"
#include "sim/geometry/Probe.h"
#include "sim/machine/Machine.h"
#include "sim/machine/MotionWatcher.h"
#include "sim/machine/Recent.h"
#include "support/Diagnostics.h"

#include <string_view>
#include <vector>

namespace dotek::sim {

enum class Outcome : std::uint8_t {
  Contact,       // of a skip move that began free
  EarlyContact,  // the ball touched before the skip move began, or in a feed that measures nothing
  Miss,          // a skip move to its end without a touch
  NotArmed,      // the ball touched and the probe was off
  NoSignal,      // the ball touched, and the path ended before the signal
  Overtravel,    // the stylus is pushed beyond it bears
  StemCollision, // the stem touches
  BodyCollision, // the body touches
  RapidIntoPart, // the ball touches in rapid
  StartInside,   // ball, stem or body is in the part before anything has moved
  OutsideTravel, // the machine would leave its travel
  SetterMiss,    // a skip move of a tool to its end without a touch of the tool setter
  SetterHit,     // something meets the tool setter and does not measure
  NotModelled,   // a rotary or a second axis is off zero, or the position of the machine is not known
};
std::string_view outcomeName(Outcome outcome); // "contact", "rapid-into-part"

struct ProbeEvent {
  Outcome outcome = Outcome::Miss;
  MotionKind kind = MotionKind::Feed;
  double share = 0;     // of the motion
  double depth = 0;     // mm of the path that lie after the touch
  Point3 centre;        // of the ball, in the machine
  Point3 point, normal; // touched, of the part; Contact, EarlyContact, NotArmed, NoSignal, Overtravel, rapid
  std::uint64_t line = 0;    // of the program
  bool placeUnknown = false; // of NotModelled: where the machine is
  bool meant = false;        // of Miss: the move was to meet nothing
  // Of EarlyContact at the start of a skip move, and of StartInside: how far the ball was from the part
  // there, below 0 in it; and the line of the move before it, 0: there is none.
  double gap = 0;
  std::uint64_t lineBefore = 0;
  bool used = false; // of a miss: its skip position was taken for the surface
  // Of OutsideTravel: the first axis that leaves, where the move would take it, and the end of its travel
  // that it passes, in coordinates of the machine.
  std::size_t axis = 0;
  double reached = 0, limit = 0;
  std::string_view what;  // of SetterHit: "a rapid move", ...; of StartInside: "ball", ...
  std::uint32_t tool = 0; // of NotModelled: this tool is in no list of the machine
  double below = 0;       // of SetterHit: from the centre to the lowest point
};

// Coordinates of the machine are those of the spindle's gauge line, with the probe pointing along -Z. Rapids
// are taken to be straight. One world goes with one machine, in one thread; the part is shared.
class World : public SkipSignal, public MotionWatcher {
public:
  // An empty part touches nothing; then only the travel is looked at.
  World(Part part, const Probe& probe, const MachineLimits& limits = {});

  // The share of the path at which the machine stops; nothing: no signal comes. Each call is a touch of its
  // own for the noise.
  std::optional<double> contact(const SkipMove& move) override;
  // The probe is on and the part deflects it. No event.
  bool isThere(const SkipMove& here) override;
  // Rapids and feeds; a Skip has been looked at by contact() and is passed over.
  void moved(const MachineMotion& motion) override;

  void probeSwitched(bool on) override { on_ = on; }
  void setOn(bool on) { on_ = on; }
  bool on() const { return on_; }
  void setLine(std::uint64_t line) { line_ = line; } // of the skip moves to come
  // Tools besides the probe, and the tool setter. The number of the tool in the spindle; 0: the probe.
  void setDevices(Devices devices) { devices_ = std::move(devices); }
  void toolChanged(std::uint32_t number) override { tool_ = number; }
  void setPart(Part part);
  // For programs that run in it: what they measure counts as equal to what lies no farther from it (mm), as
  // if it fell on a limit exactly.
  void setTie(double tie) { tie_ = tie; }
  double tie() const { return tie_; }
  // As at the start: the events are forgotten, the noise begins anew with `seed`.
  void restart(std::uint64_t seed);

  const std::vector<ProbeEvent>& events() const { return events_; }
  void forgetEvents() { events_.clear(); } // of a run that is too long to keep them all
  const Probe& probe() const { return probe_; }
  const Part& part() const { return part_; }
  // Of the ball, or of a tool's end, where the machine is at `position`.
  Point3 centreAt(const Position& position) const;
  // In the spindle; nullptr: the probe is.
  const CuttingTool* cuttingTool() const { return devices_.find(tool_); }
  // A tool is in the spindle that is neither the probe nor one of the machine's file.
  bool isUnknownTool() const;
  // Of such a tool the program's own length is all that is known, 0 or more: the one in force.
  void setLengthInForce(double length) { lengthInForce_ = length; }
  CuttingTool unknownTool() const { return {tool_, lengthInForce_, 0}; }

private:
  std::optional<Touch> touchOf(double radius, const Point3& from, const Point3& to);
  struct Obstacle {
    Outcome outcome;
    double share;
  };
  std::optional<SetterTouch> setterTouch(const Point3& from, const Point3& to) const;
  std::optional<double> toolContact(const SkipMove& move);
  ProbeEvent& addSetter(Outcome outcome, MotionKind kind, const SetterTouch& touch, const Point3& from,
                        const Point3& way);
  void setterHit(const MachineMotion& motion);
  bool isModelled(const Position& from, const Position& to) const;
  struct Leaving {
    double share;
    std::size_t axis;
    double reached, limit;
  };
  std::optional<Leaving> leavesTravel(const Position& from, const Position& to) const;
  std::optional<Obstacle> obstacle(const Point3& from, const Point3& way);
  std::optional<Obstacle> findObstacle(const Point3& from, const Point3& way) const;
  // Is where the last motion ended, which was reported.
  bool isOld(const Obstacle& hit, double length) const;
  double noise();
  ProbeEvent& add(Outcome outcome, MotionKind kind, double share, const Point3& centre);
  void addLeaving(const Leaving& leaves, MotionKind kind, const Point3& from, const Point3& way);
  ProbeEvent& addTouch(Outcome outcome, MotionKind kind, const Touch& touch, double length);
  // Before the first motion: what is in the part already is one event, and no fault of the move.
  bool beginsInside(MotionKind kind, const Position& position);
  // The events of the first motion at its start, from the `before`-th on: they follow from that.
  void dropStart(std::size_t before);
  std::optional<double> contactOf(const SkipMove& move);
  void move(const MachineMotion& motion);
  void settle(const Touch& touch, const MachineMotion& motion, double length);

  Part part_;
  Probe probe_;
  double tie_ = 0;
  MachineLimits limits_;
  Devices devices_;
  std::uint32_t tool_ = 0;
  double lengthInForce_ = 0;
  bool on_;
  std::uint64_t lastLine_ = 0; // of the last motion
  bool begun_ = false;         // something has moved
  bool pressed_ = false;       // the last motion ended in the part, which was reported
  std::uint64_t line_ = 0;
  std::uint64_t seed_;
  std::uint64_t touches_ = 0;
  std::vector<ProbeEvent> events_;
  // A macro touches twice, and of two programs that are compared the second does what the first did.
  Recent<std::optional<Touch>> recentTouches_;
  Recent<std::optional<Obstacle>> recentObstacles_;
};

// What went wrong, as a finding at `range`. A contact is none; a miss is a note, since a protected move is
// meant to miss.
void reportEvent(const ProbeEvent& event, SourceRange range, Diagnostics& diagnostics);

} // namespace dotek::sim
