// Where the probe is before each statement of a body, as far as the moves tell.
#pragma once

#include "ir/Cycle.h"

#include <array>
#include <map>
#include <vector>

namespace dotek::ir {

// One axis. Work: `point` is at coordinate `value` of the active work system. Start: entry position plus
// `value`. Unknown where paths disagree, or where an opaque block or a variable that changed since is
// between. `point` is Centre or, along Z, Lowest; of a Start position that only relative travels reached it
// is Centre whatever point the caller placed.
struct AxisPosition {
  enum class State : std::uint8_t { Unknown, Work, Start };
  State state = State::Start;
  ExpressionPtr value; // null pointer for Unknown
  ProbePoint point = ProbePoint::Centre;
};
using Position = std::array<AxisPosition, 3>; // by Axis

// One entry for each statement of `cycle.body`: before it. Unreachable statements: Unknown. A measurement
// returns to where it began; where it may set the active work system, the axes that it sets become
// Unknown; after a cycle that does not return all are. A change of the work system makes all axes Unknown; a
// coordinate in the machine's or the retract frame, in another work system, of the contact point or read from
// a machine variable makes its axis Unknown.
std::vector<Position> positions(const Cycle& cycle);
// Where locals take the place of the probe, by axis, whatever their assignments say: of a cycle of which they
// are not written yet. A move to such a coordinate, or to a host input start_x, start_y, start_z, leads back
// to what was known there, and a Start position is a place that outlasts a change of its coordinates.
std::vector<Position> positions(const Cycle& cycle, const std::map<VariableId, Axis>& places);

// The last Measure or CallCycle before each statement of the body, on every path; nullptr: none, paths
// disagree, or an opaque block, which may measure, is between. Points into `cycle.body`.
std::vector<const CycleStatement*> lastMeasurements(const Cycle& cycle);

// Whether the statement switches the probe on or off; nullopt: neither.
std::optional<bool> switchesProbe(const CycleStatement& statement);
// The statement touches: a measurement or a protected move.
bool probes(const CycleStatement& statement);
// Whether a statement of the body does.
bool probes(const Cycle& cycle);

// Whether a coordinate of the body counts from `frame`. With Retract the cycle needs the plane's height
// though no expression names it.
bool countsFrom(const Cycle& cycle, Frame frame);

} // namespace dotek::ir
