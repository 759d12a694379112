// What the watcher of a machine is reported: motions in coordinates of the machine. Blocks that set a tool's
// length, an offset or a system move nothing.
#include "sim/machine/Axes.h"
#include "sim/machine/Machine.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dotek::sim {
namespace {

constexpr double kChordError = 0.005; // mm between an arc and its chords, at most
constexpr double kWidestChord = std::numbers::pi / 4;
// G73 goes back by this much after a peck, G83 comes as near to the last one: parameters, and no source says
// what they are on most machines.
constexpr double kPeckReturn = 1;
constexpr double kMostPecks = 10'000;

// Cycles that leave the hole at the feed, up to level R: G74, G84 tap, G85 and G89 bore.
bool feedsBack(std::uint32_t tenths) {
  return tenths == 740 || tenths == 840 || tenths == 850 || tenths == 890;
}

} // namespace

void Machine::tellTo(MotionKind kind, const Position& to, std::uint32_t lost) {
  const bool known = (lost_ | lost) == 0;
  const Position from = at_;
  at_ = to;
  lost_ = lost;
  watcher_->moved({kind, from, to, stack_.back().line, known});
}

void Machine::tellMotion(MotionKind kind, std::uint32_t axes, bool certain) {
  const Position now = machinePosition();
  Position to = at_;
  for (std::size_t i = 0; i < kAxes; ++i)
    if ((axes >> i & 1) != 0) to[i] = now[i];
  std::uint32_t lost = certain ? lost_ & ~axes : lost_ | axes;
  if (lengthInDoubt_) lost |= axes & 1u << 2;
  tellTo(kind, to, lost);
}

Position Machine::knownOf(Position position, std::uint32_t unknown) {
  for (std::size_t i = 0; i < kAxes; ++i)
    if ((unknown >> i & 1) != 0) position[i] = std::nan("");
  return position;
}

Position Machine::knownMachinePosition() const {
  const Position now = machinePosition();
  std::uint32_t unknown = 0;
  for (std::size_t i = 0; i < kAxes; ++i) {
    const bool told = watcher_ != nullptr && (lost_ >> i & 1) == 0 && at_[i] == now[i];
    if ((uncertain_ >> i & 1) != 0 && !told) unknown |= 1u << i;
  }
  return knownOf(now, unknown);
}

void Machine::tellArc(const PlaneAxes& plane, std::uint32_t axes, double first, double second,
                      const Position& begin) {
  const Position now = machinePosition();
  const Position from = at_;
  const double du = work_[plane.first] - begin[plane.first];
  const double dv = work_[plane.second] - begin[plane.second];
  const double radius = std::hypot(first, second);
  const double endRadius = std::hypot(du - first, dv - second);
  const double angle = std::atan2(-second, -first);
  double sweep = std::atan2(dv - second, du - first) - angle;
  const bool left = modes_[kMotion] == kArcCounterClockwise;
  constexpr double kTurn = 2 * std::numbers::pi;
  if (du == 0 && dv == 0)
    sweep = left ? kTurn : -kTurn;
  else if (left && sweep <= 0)
    sweep += kTurn;
  else if (!left && sweep >= 0)
    sweep -= kTurn;
  const double widest = std::max(radius, endRadius);
  const double chord =
      widest > kChordError ? std::min(kWidestChord, 2 * std::acos(1 - kChordError / widest)) : kWidestChord;
  const auto chords = static_cast<std::uint32_t>(std::max(1.0, std::ceil(std::abs(sweep) / chord)));
  const bool doubt = lengthInDoubt_ && (axes >> 2 & 1) != 0;
  for (std::uint32_t n = 1; n < chords && running(); ++n) {
    const double share = static_cast<double>(n) / chords;
    const double r = radius + (endRadius - radius) * share;
    Position to = from;
    for (std::size_t i = 0; i < kAxes; ++i)
      if ((axes >> i & 1) != 0) to[i] = from[i] + (now[i] - from[i]) * share;
    to[plane.first] = from[plane.first] + first + r * std::cos(angle + sweep * share);
    to[plane.second] = from[plane.second] + second + r * std::sin(angle + sweep * share);
    tellTo(MotionKind::Feed, to, doubt ? lost_ | 1u << 2 : lost_);
  }
  if (!running()) return;
  // An axis of the plane that the block does not name ends where it began.
  tellMotion(MotionKind::Feed, axes | ((1u << plane.first | 1u << plane.second) & ~lost_));
}

// Over the hole, down to level R, down to its bottom, and back.
void Machine::tellHole(const Position& hole, std::uint32_t axes, std::size_t depth) {
  const std::uint32_t down = 1u << depth;
  const auto go = [&](MotionKind kind, std::uint32_t moved, const Position& to, bool certain = true) {
    if (!running()) return;
    work_ = to;
    tellMotion(kind, moved, certain);
  };
  Position at = hole;
  at[depth] = work_[depth];
  if ((axes & ~down) != 0) go(MotionKind::Rapid, axes & ~down, at);
  const std::uint32_t lost = lost_;
  if (modes_[kCanned] == 2) {
    // Back boring goes down beside the axis of the hole, by a shift that is not followed.
    go(MotionKind::Feed, down, hole, false);
    lost_ = lost;
    return;
  }
  const Code* const code = cannedCode();
  const auto to = [&](MotionKind kind, double level) {
    at[depth] = level;
    go(kind, down, at);
  };
  to(MotionKind::Rapid, cycleR_);
  const bool breaks = code != nullptr && code->tenths == 730, clears = code != nullptr && code->tenths == 830;
  const double whole = std::abs(cycleDepth_ - cycleR_), way = cycleDepth_ < cycleR_ ? -1 : 1;
  if ((breaks || clears) && cyclePeck_ > 0 && whole / cyclePeck_ < kMostPecks) {
    for (int peck = 1; peck * cyclePeck_ < whole; ++peck) {
      const double level = snap(cycleR_ + way * peck * cyclePeck_);
      const double back = snap(cycleR_ + way * std::max(0.0, peck * cyclePeck_ - kPeckReturn));
      to(MotionKind::Feed, level);
      if (clears) to(MotionKind::Rapid, cycleR_);
      to(MotionKind::Rapid, back);
    }
  }
  to(MotionKind::Feed, cycleDepth_);
  if (cycleDwell_ > 0 && running()) watcher_->dwelled(cycleDwell_);
  if (code != nullptr && feedsBack(code->tenths)) to(MotionKind::Feed, cycleR_); // from there it is rapid
  if (at[depth] != hole[depth]) go(MotionKind::Rapid, down, hole);
}

} // namespace dotek::sim
