// Moves of a cycle, and the frames of their coordinates.
#include "sim/cycle/CycleRun.h"
#include "sim/machine/Paths.h"

namespace dotek::sim {

namespace {

constexpr std::size_t kZ = 2;

} // namespace

double CycleRun::shift(std::size_t axis) const {
  return machine_.machinePosition()[axis] - machine_.position()[axis];
}

std::optional<double> CycleRun::coordinate(const ir::Coordinate& target, std::size_t axis,
                                           ir::ProbePoint point) {
  const std::optional<double> value = number(target.value);
  if (!value) return std::nullopt;
  // From the point that is meant down to the lowest one.
  const double rise = axis == kZ && point == ir::ProbePoint::Centre ? inputs_.ballRadius : 0;
  switch (target.frame) {
  case ir::Frame::Here: return machine_.position()[axis] + *value;
  case ir::Frame::Start: return start_[axis] - shift(axis) + *value;
  case ir::Frame::Machine: return *value - shift(axis); // of the spindle's gauge line
  case ir::Frame::Retract:
    if (inputs_.retract) return *inputs_.retract + *value - rise;
    inconclusive("the height of the retract plane is not known; `--host retract=MM` says it");
    return std::nullopt;
  case ir::Frame::Work: break;
  }
  if (!target.system) return *value - rise;
  const auto which = system(target.system);
  if (!which) return std::nullopt;
  return *value - rise + machine_.offsetOf(*which, axis) - machine_.offsetOf(machine_.activeSystem(), axis);
}

bool CycleRun::goTo(const Position& end, MotionKind kind, std::optional<double> feed) {
  return caller_ != nullptr ? machine_.travelTo(end) : machine_.goTo(end, kind, feed);
}

bool CycleRun::protectedTo(const Position& end) {
  if (distance(machine_.position(), end) < kNoPath) return true;
  if (nominal_) return goTo(end, MotionKind::Feed);
  protected_ = true;
  const std::optional<bool> contact =
      machine_.probeTo(end, true, caller_ == nullptr ? "protected" : "probing");
  protected_ = false;
  if (!contact) return false;
  // One that touches where it ends has got there.
  const bool stopped = *contact && distance(machine_.position(), end) > kNoPath;
  return !stopped || alarm(stdlib::MacroAlarm::PathObstructed);
}

bool CycleRun::move(const ir::Move& node) {
  if (node.point == ir::ProbePoint::Contact)
    return inconclusive("which way the ball would touch the target of this move is not known");
  Position end = machine_.position();
  for (const ir::Axis axis : ir::kAxes) {
    const std::size_t i = ir::indexOf(axis);
    if (!node.axes[i]) continue;
    const std::optional<double> to = coordinate(*node.axes[i], i, node.point);
    if (!to) return false;
    end[i] = *to;
  }
  std::optional<double> feed;
  if (node.feed) {
    feed = number(node.feed);
    if (!feed) return false;
    if (!(*feed > 0)) return raise("a feed that is not above 0");
  }
  switch (node.motion) {
  case ir::Motion::Rapid: return goTo(end, MotionKind::Rapid);
  case ir::Motion::Feed: return goTo(end, MotionKind::Feed, feed);
  case ir::Motion::Protected: break;
  }
  if (feed) machine_.setFeed(*feed);
  MotionWatcher* const watcher = this->watcher();
  if (watcher != nullptr) watcher->protectedBegins(feed);
  if (!protectedTo(end)) return false;
  if (watcher != nullptr) watcher->protectedEnded();
  return true;
}

} // namespace dotek::sim
