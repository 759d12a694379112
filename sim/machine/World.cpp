#include "sim/machine/World.h"

#include "support/Decimal.h"
#include "support/messages/Part.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <string>
#include <utility>

namespace dotek::sim {
namespace {

std::uint64_t mixed(std::uint64_t x) { // SplitMix64
  x += 0x9E3779B97F4A7C15u;
  x = (x ^ x >> 30) * 0xBF58476D1CE4E5B9u;
  x = (x ^ x >> 27) * 0x94D049BB133111EBu;
  return x ^ x >> 31;
}

} // namespace

World::World(Part part, const Probe& probe, const MachineLimits& limits)
    : part_(std::move(part)), probe_(probe), limits_(limits), on_(probe.on), seed_(probe.seed) {}

void World::restart(std::uint64_t seed) {
  events_.clear();
  on_ = probe_.on;
  begun_ = pressed_ = false;
  lastLine_ = 0;
  seed_ = seed;
  touches_ = 0;
}

Point3 World::centreAt(const Position& position) const {
  if (const CuttingTool* tool = cuttingTool()) return {position[0], position[1], position[2] - tool->length};
  if (isUnknownTool()) return {position[0], position[1], position[2] - lengthInForce_};
  return {position[0], position[1], position[2] - probe_.centreLength()};
}

void World::setPart(Part part) {
  part_ = std::move(part);
  recentTouches_.forget();
  recentObstacles_.forget();
}

std::optional<Touch> World::touchOf(double radius, const Point3& from, const Point3& to) {
  if (part_.isEmpty()) return std::nullopt;
  return recentTouches_.of(from, to, radius, [&] { return firstContact(part_, radius, from, to); });
}

bool World::isThere(const SkipMove& here) {
  // A position that a touch has stopped at counts as one that deflects the stylus, whatever the noise was.
  constexpr double kNear = 1e-6;
  return on_ && !part_.isEmpty() &&
         part_.distance(centreAt(here.machineFrom)) <= probe_.effectiveRadius + 3 * probe_.noise + kNear;
}

bool World::isModelled(const Position& from, const Position& to) const {
  if (part_.isEmpty()) return true;
  for (std::size_t axis = 3; axis < kAxes; ++axis) {
    if (from[axis] != 0 || to[axis] != 0) return false;
  }
  return true;
}

// The first axis that leaves its travel, and at which share. A machine that is outside may come back.
std::optional<World::Leaving> World::leavesTravel(const Position& from, const Position& to) const {
  std::optional<Leaving> out;
  for (std::size_t axis = 0; axis < limits_.travel.size(); ++axis) {
    if (!limits_.travel[axis]) continue;
    const auto [least, most] = *limits_.travel[axis];
    const double end = to[axis] < least ? least : to[axis] > most ? most : to[axis];
    const double way = to[axis] - from[axis];
    if (end == to[axis] || (end == least ? way >= 0 : way <= 0)) continue;
    const double share = std::clamp((end - from[axis]) / way, 0.0, 1.0);
    if (!out || share < out->share) out = {share, axis, to[axis], end};
  }
  return out;
}

void World::addLeaving(const Leaving& leaves, MotionKind kind, const Point3& from, const Point3& way) {
  ProbeEvent& event = add(Outcome::OutsideTravel, kind, leaves.share, from + way * leaves.share);
  event.axis = leaves.axis;
  event.reached = leaves.reached;
  event.limit = leaves.limit;
}

bool World::isOld(const Obstacle& hit, double length) const {
  constexpr double kNear = 0.002; // collisions are found on the safe side by half of it
  return pressed_ && hit.share * length <= kNear;
}

std::optional<World::Obstacle> World::obstacle(const Point3& from, const Point3& way) {
  if (!(probe_.stemDiameter > 0) || part_.isEmpty()) return std::nullopt;
  return recentObstacles_.of(from, way, 0, [&] { return findObstacle(from, way); });
}

// The stem or the body on the path, the earlier of the two.
std::optional<World::Obstacle> World::findObstacle(const Point3& from, const Point3& way) const {
  std::optional<Obstacle> out;
  const Point3 top = from + Point3{0, 0, probe_.stemLength};
  if (const auto share = firstCollision(part_, {from, top, probe_.stemDiameter / 2}, way))
    out = {Outcome::StemCollision, *share};
  if (!(probe_.bodyDiameter > 0)) return out;
  // Its round end lies within it.
  const double radius = probe_.bodyDiameter / 2;
  const Point3 low = top + Point3{0, 0, radius};
  const Point3 high = top + Point3{0, 0, std::max(radius, probe_.bodyLength)};
  const auto share = firstCollision(part_, {low, high, radius}, way);
  if (share && (!out || *share < out->share)) out = {Outcome::BodyCollision, *share};
  return out;
}

// Twelve even numbers make a bell; what is beyond three deviations is drawn anew.
double World::noise() {
  if (!(probe_.noise > 0)) return 0;
  std::uint64_t state = mixed(seed_ ^ mixed(touches_));
  for (;;) {
    double sum = -6;
    for (int n = 0; n < 12; ++n) {
      state = mixed(state);
      sum += static_cast<double>(state >> 11) / 9007199254740992.0; // 2^53
    }
    if (std::abs(sum) <= 3) return sum * probe_.noise;
  }
}

ProbeEvent& World::add(Outcome outcome, MotionKind kind, double share, const Point3& centre) {
  ProbeEvent event;
  event.outcome = outcome;
  event.kind = kind;
  event.share = share;
  event.centre = centre;
  event.line = line_;
  events_.push_back(event);
  return events_.back();
}

ProbeEvent& World::addTouch(Outcome outcome, MotionKind kind, const Touch& touch, double length) {
  ProbeEvent& event = add(outcome, kind, touch.share, touch.centre);
  event.point = touch.point;
  event.normal = touch.normal;
  event.depth = (1 - touch.share) * length;
  return event;
}

// By less than half a millimetre the stylus may be pressed, as after a touch.
bool World::beginsInside(MotionKind kind, const Position& position) {
  if (std::exchange(begun_, true) || part_.isEmpty() || !isModelled(position, position)) return false;
  if (cuttingTool() != nullptr || isUnknownTool()) return false;
  constexpr double kDeep = 0.5; // mm
  const Point3 centre = centreAt(position);
  const double gap = part_.distance(centre) - probe_.ballRadius();
  const auto isWithin = [&](double low, double high, double radius) {
    for (double height = low; height <= high;) {
      const double free = part_.distance(centre + Point3{0, 0, height}) - radius;
      if (free < -kDeep) return true;
      height += std::max(free, kDeep / 2);
    }
    return false;
  };
  const double stem = probe_.stemDiameter / 2, body = probe_.bodyDiameter / 2;
  const double low = probe_.stemLength + body;
  std::string_view what;
  if (gap < -kDeep)
    what = "ball";
  else if (stem > 0 && isWithin(0, probe_.stemLength, stem))
    what = "stem of the stylus";
  else if (stem > 0 && body > 0 && isWithin(low, std::max(low, probe_.stemLength + probe_.bodyLength), body))
    what = "body of the probe";
  if (what.empty()) return false;
  ProbeEvent& event = add(Outcome::StartInside, kind, 0, centre);
  event.what = what;
  event.gap = gap;
  return true;
}

void World::dropStart(std::size_t before) {
  const auto begin = events_.begin() + static_cast<std::ptrdiff_t>(before);
  events_.erase(std::remove_if(begin, events_.end(),
                               [](const ProbeEvent& event) {
                                 return event.share <= 0 && event.outcome != Outcome::OutsideTravel &&
                                        event.outcome != Outcome::SetterHit &&
                                        event.outcome != Outcome::SetterMiss &&
                                        event.outcome != Outcome::Miss &&
                                        event.outcome != Outcome::NotModelled;
                               }),
                events_.end());
}

std::optional<double> World::contact(const SkipMove& move) {
  const bool inside = beginsInside(MotionKind::Skip, move.machineFrom);
  const std::size_t before = events_.size();
  const std::optional<double> out = contactOf(move);
  if (inside) dropStart(before);
  return out;
}

std::optional<double> World::contactOf(const SkipMove& move) {
  constexpr MotionKind kKind = MotionKind::Skip;
  ++touches_;
  const Point3 from = centreAt(move.machineFrom), to = centreAt(move.machineTo);
  const std::uint64_t lineBefore = std::exchange(lastLine_, line_);
  if (!isModelled(move.machineFrom, move.machineTo)) {
    add(Outcome::NotModelled, kKind, 0, from);
    return std::nullopt;
  }
  if (isUnknownTool()) {
    add(Outcome::NotModelled, kKind, 0, from).tool = tool_;
    return std::nullopt;
  }
  if (cuttingTool() != nullptr) return toolContact(move);
  setterHit({MotionKind::Skip, move.machineFrom, move.machineTo, line_, true});
  const Point3 way = to - from;
  const double length = way.length();
  const std::optional<Touch> touch = touchOf(probe_.ballRadius(), from, to);
  // Where the signal comes; more than 1: it does not.
  double signal = 2;
  if (touch && touch->atStart) {
    signal = 0;
  } else if (touch) {
    std::optional<Touch> trigger = touch;
    if (probe_.effectiveRadius < probe_.ballRadius()) trigger = touchOf(probe_.effectiveRadius, from, to);
    if (trigger && length > 0) signal = std::max(0.0, trigger->share + (probe_.preTravel + noise()) / length);
  }
  double stop = on_ ? std::min(signal, 1.0) : 1;
  // What the stem or the body meets behind the ball's touch is no news.
  const double reach = touch ? std::min(touch->share, stop) : stop;
  bool blocked = false;
  if (const auto hit = obstacle(from, way * reach); hit && hit->share < 1 && !isOld(*hit, reach * length)) {
    const double share = hit->share * reach;
    add(hit->outcome, kKind, share, from + way * share);
    blocked = true;
    // A bent stem opens the contact, too.
    if (hit->outcome == Outcome::StemCollision && on_) signal = stop = share;
  }
  const auto leaves = leavesTravel(move.machineFrom, move.machineTo);
  if (leaves && leaves->share < stop) {
    // The control stops the machine there: the move comes to no end, and looks for nothing any more.
    addLeaving(*leaves, kKind, from, way);
    pressed_ = blocked;
    return std::nullopt;
  }
  if (!touch) {
    if (!blocked) add(Outcome::Miss, kKind, 1, to).meant = move.positions;
  } else if (blocked && touch->share > stop) {
    // The machine does not come as far.
  } else if (!on_) {
    addTouch(Outcome::NotArmed, kKind, *touch, length);
  } else if (touch->atStart) {
    ProbeEvent& event = addTouch(Outcome::EarlyContact, kKind, *touch, length);
    event.depth = 0;
    event.gap = part_.distance(from) - probe_.ballRadius();
    event.lineBefore = lineBefore;
  } else if (signal > 1) {
    addTouch(Outcome::NoSignal, kKind, *touch, length);
  } else {
    addTouch(Outcome::Contact, kKind, *touch, length).depth = (signal - touch->share) * length;
  }
  pressed_ = touch.has_value() || blocked;
  if (!on_ || signal > 1) return std::nullopt;
  return signal;
}

void World::moved(const MachineMotion& motion) {
  if (motion.kind == MotionKind::Skip) return;
  if (motion.line != 0) lastLine_ = line_ = motion.line;
  if (!motion.known) begun_ = true;
  const bool inside = beginsInside(motion.kind, motion.from);
  const std::size_t before = events_.size();
  move(motion);
  if (inside) dropStart(before);
}

void World::move(const MachineMotion& motion) {
  const Point3 from = centreAt(motion.from), to = centreAt(motion.to);
  if (!motion.known || !isModelled(motion.from, motion.to)) {
    add(Outcome::NotModelled, motion.kind, 0, from).placeUnknown = !motion.known;
    return;
  }
  const Point3 way = to - from;
  if (const auto leaves = leavesTravel(motion.from, motion.to)) addLeaving(*leaves, motion.kind, from, way);
  if (motion.from == motion.to) return;
  setterHit(motion);
  if (cuttingTool() != nullptr || isUnknownTool()) return; // what it cuts is no business of the probe
  const std::optional<Touch> touch = touchOf(probe_.ballRadius(), from, to);
  const auto hit = obstacle(from, way);
  if (hit && (!touch || hit->share < touch->share) && !isOld(*hit, way.length()))
    add(hit->outcome, motion.kind, hit->share, from + way * hit->share);
  // Backing off from where a stem was told to collide is no second collision.
  pressed_ = touch.has_value() || hit.has_value();
  if (touch) settle(*touch, motion, way.length());
}

// A touch that no skip move asked for. Nothing stops the machine.
void World::settle(const Touch& touch, const MachineMotion& motion, double length) {
  Outcome outcome = Outcome::EarlyContact;
  if (motion.kind == MotionKind::Rapid)
    outcome = Outcome::RapidIntoPart;
  else if ((1 - touch.share) * length > probe_.overtravel)
    outcome = Outcome::Overtravel;
  else if (!on_)
    outcome = Outcome::NotArmed;
  addTouch(outcome, motion.kind, touch, length);
}

std::string_view outcomeName(Outcome outcome) {
  switch (outcome) {
  case Outcome::Contact: return "contact";
  case Outcome::EarlyContact: return "early-contact";
  case Outcome::Miss: return "miss";
  case Outcome::NotArmed: return "not-armed";
  case Outcome::NoSignal: return "no-signal";
  case Outcome::Overtravel: return "overtravel";
  case Outcome::StemCollision: return "stem-collision";
  case Outcome::BodyCollision: return "body-collision";
  case Outcome::RapidIntoPart: return "rapid-into-part";
  case Outcome::StartInside: return "start-inside";
  case Outcome::OutsideTravel: return "outside-travel";
  case Outcome::SetterMiss: return "setter-miss";
  case Outcome::SetterHit: return "setter-collision";
  case Outcome::NotModelled: return "not-modelled";
  }
  return "";
}

namespace {

// What is known of the move that brought the ball there.
std::string beforeText(const ProbeEvent& event) {
  constexpr double kSeen = 0.0005; // mm
  const std::string where = event.gap < -kSeen  ? fixedText(-event.gap, 3) + " mm inside the part"
                            : event.gap > kSeen ? fixedText(event.gap, 3) + " mm from the part"
                                                : "against the part";
  if (event.lineBefore == 0) return "the program begins with the ball " + where;
  return "the move before it, in line " + std::to_string(event.lineBefore) + ", ended with the ball " + where;
}

} // namespace

void reportEvent(const ProbeEvent& event, SourceRange range, Diagnostics& diagnostics) {
  const auto at = [](const Point3& p) {
    return "X" + fixedText(p.x, 3) + " Y" + fixedText(p.y, 3) + " Z" + fixedText(p.z, 3);
  };
  const std::string centre = at(event.centre), depth = fixedText(event.depth, 3);
  switch (event.outcome) {
  case Outcome::Contact: return;
  case Outcome::EarlyContact:
    if (event.kind == MotionKind::Skip)
      diagnostics.report<diag::ContactAtStart>(range, centre, beforeText(event));
    else
      diagnostics.report<diag::EarlyContact>(range, centre);
    return;
  case Outcome::Miss: diagnostics.report<diag::ProbeMiss>(range, centre); return;
  case Outcome::NotArmed: diagnostics.report<diag::ProbeNotArmed>(range, centre, depth); return;
  case Outcome::NoSignal: diagnostics.report<diag::NoProbeSignal>(range, centre, depth); return;
  case Outcome::Overtravel: diagnostics.report<diag::ProbeOvertravel>(range, centre, depth); return;
  case Outcome::StemCollision: diagnostics.report<diag::StemCollision>(range, centre); return;
  case Outcome::BodyCollision: diagnostics.report<diag::BodyCollision>(range, centre); return;
  case Outcome::RapidIntoPart: diagnostics.report<diag::RapidIntoPart>(range, centre, depth); return;
  case Outcome::StartInside:
    diagnostics.report<diag::StartInside>(range,
                                          event.gap < 0
                                              ? fmt::format("{} {} mm", event.what, fixedText(-event.gap, 3))
                                              : std::string(event.what),
                                          centre);
    return;
  case Outcome::OutsideTravel: {
    const char letter = kAxisLetters[event.axis];
    const auto value = [&](double place) { return letter + fixedText(place, 3); };
    diagnostics.report<diag::OutsideTravel>(range,
                                            std::string{letter, event.reached > event.limit ? '+' : '-'},
                                            value(event.reached), value(event.limit));
    return;
  }
  case Outcome::SetterMiss: diagnostics.report<diag::SetterMiss>(range, centre); return;
  case Outcome::SetterHit:
    diagnostics.report<diag::SetterCollision>(range, event.what, at(event.centre - Point3{0, 0, event.below}),
                                              depth);
    return;
  case Outcome::NotModelled:
    if (event.placeUnknown)
      diagnostics.report<diag::PlaceNotKnown>(range);
    else
      diagnostics.report<diag::AxisNotModelled>(range);
    return;
  }
}

} // namespace dotek::sim
