// A tool in the spindle, and the tool setter. What a tool cuts is not looked at.
#include "sim/machine/World.h"

#include <algorithm>

namespace dotek::sim {

bool World::isUnknownTool() const {
  return tool_ != 0 && devices_.probeTool && tool_ != *devices_.probeTool && cuttingTool() == nullptr;
}

std::optional<SetterTouch> World::setterTouch(const Point3& from, const Point3& to) const {
  if (!devices_.setter || isUnknownTool()) return std::nullopt;
  const CuttingTool* const tool = cuttingTool();
  if (tool != nullptr) return firstTouch(*devices_.setter, tool->diameter / 2, from, to);
  // The probe's lowest point.
  const Point3 down{0, 0, -probe_.ballRadius()};
  return firstTouch(*devices_.setter, probe_.ballRadius(), from + down, to + down);
}

ProbeEvent& World::addSetter(Outcome outcome, MotionKind kind, const SetterTouch& touch, const Point3& from,
                             const Point3& way) {
  ProbeEvent& event = add(outcome, kind, touch.share, from + way * touch.share);
  event.point = touch.point;
  event.normal = touch.normal;
  event.depth = (1 - touch.share) * way.length();
  event.below = cuttingTool() == nullptr ? probe_.ballRadius() : 0;
  return event;
}

std::optional<double> World::toolContact(const SkipMove& move) {
  constexpr MotionKind kKind = MotionKind::Skip;
  const Point3 from = centreAt(move.machineFrom), to = centreAt(move.machineTo), way = to - from;
  const double length = way.length();
  const std::optional<SetterTouch> touch = setterTouch(from, to);
  std::optional<double> signal;
  bool presses = false;
  if (touch && touch->atStart)
    signal = 0;
  else if (touch && devices_.setter->triggers[touch->direction])
    signal = touch->share + devices_.setter->preTravel / length;
  if (signal && *signal > 1) signal.reset();
  const double stop = signal.value_or(1);
  if (const auto leaves = leavesTravel(move.machineFrom, move.machineTo); leaves && leaves->share < stop) {
    addLeaving(*leaves, kKind, from, way);
    return std::nullopt;
  }
  if (!touch) {
    add(Outcome::SetterMiss, kKind, 1, to).meant = move.positions;
  } else if (!devices_.setter->triggers[touch->direction]) {
    addSetter(Outcome::SetterHit, kKind, *touch, from, way).what =
        "from a side that gives no signal the tool";
    signal.reset();
    presses = true;
  } else if (touch->atStart) {
    addSetter(Outcome::SetterHit, kKind, *touch, from, way).what = "before the skip move begins the tool";
  } else if (!signal) {
    // Pushed, and not as far as to the signal.
    add(Outcome::SetterMiss, kKind, 1, to);
  } else {
    addSetter(Outcome::Contact, kKind, *touch, from, way).depth = (*signal - touch->share) * length;
  }
  pressed_ = presses || signal.has_value();
  return signal;
}

void World::setterHit(const MachineMotion& motion) {
  const Point3 from = centreAt(motion.from), to = centreAt(motion.to), way = to - from;
  const std::optional<SetterTouch> touch = setterTouch(from, to);
  if (!touch) return;
  const bool tool = cuttingTool() != nullptr;
  ProbeEvent& event = addSetter(Outcome::SetterHit, motion.kind, *touch, from, way);
  if (motion.kind == MotionKind::Skip)
    event.what = "the probe";
  else if (motion.kind == MotionKind::Rapid)
    event.what = tool ? "in a rapid move the tool" : "in a rapid move the probe";
  else
    event.what = tool ? "in a feed that waits for no signal the tool" : "in a feed the probe";
}

} // namespace dotek::sim
