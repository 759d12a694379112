// G40 to G42 where an offset of the tool's radius is set: the path beside that of the program. A move waits
// for the next one in the plane, since that says where it ends.
#include "sim/machine/MachineOffset.h"

#include "stdlib/RadiusOffsets.h"

#include <cmath>
#include <fmt/format.h>

namespace dotek::sim {

using ir::NcWords;
using stdlib::Function;

OffsetState::OffsetState() = default;
OffsetState::~OffsetState() = default;
OffsetState::OffsetState(const OffsetState& other)
    : queue_(other.queue_ ? std::make_unique<OffsetQueue>(*other.queue_) : nullptr) {}
OffsetState& OffsetState::operator=(const OffsetState& other) {
  if (this != &other) queue_ = other.queue_ ? std::make_unique<OffsetQueue>(*other.queue_) : nullptr;
  return *this;
}

bool Machine::offsetsPath() const {
  return offsets_.active() || (modes_[kComp] != 0 && offsetRadius() != 0);
}

double Machine::offsetRadius() const {
  if (turning_ != nullptr || modes_[kComp] == 0) return 0;
  const double d = modalWords_[slotOf('D')];
  if (!(d >= 1 && d < 1e6)) return 0;
  double geometry = 0, wear = 0;
  std::size_t before = 0;
  for (const stdlib::StateRange& range : control_->state) {
    const double at = d - 1;
    // A range under other numbers counts where the first has nothing.
    if (range.title.starts_with("radius offsets of the tools") && at <= range.last - range.first) {
      const double value = state_[before + static_cast<std::size_t>(at)];
      double& sum = range.title.ends_with("wear") ? wear : geometry;
      if (!isFresh(value) && sum == 0) sum = value;
    }
    before += range.last - range.first + 1;
  }
  const double radius = snap(geometry + wear);
  return modes_[kComp] == 1 ? radius : -radius;
}

bool OffsetWork::refuse(std::string_view what, char letter) const {
  return machine_.inconclusive(
      fmt::format("{} under cutter compensation: write `G40` with a move in the plane before it", what),
      letter);
}

// Before the block moves: what it may not do while moves wait, and G40.
bool OffsetWork::before(const NcWords& w) {
  Machine& m = machine_;
  OffsetQueue& queue = *m.offsets_.queue_;
  const auto changed = [&](Slot slot) { return m.modes_[slot] != m.block_.before[slot]; };
  const bool ends = m.modes_[kComp] == 0;
  queue.moved = false;
  if (queue.stage != OffsetQueue::Stage::Leaving) {
    if (ends && !leave()) return false;
    if (!ends) {
      if (changed(kComp)) return refuse("the other side", 'G');
      const bool asks = w.has('D') || (m.block_.slots >> kComp & 1) != 0;
      if (asks && (w.has('D') ? radiusOf(w.of('D')) : m.offsetRadius()) != queue.radius)
        return refuse("another offset", w.has('D') ? 'D' : 'G');
      if (changed(kPlane)) return refuse("another plane", 'G');
      if (changed(kSystem) || (m.block_.slots >> kLength & 1) != 0)
        return refuse("another work system or tool length", 'G');
      if (m.modes_[kCanned] != 0) return refuse("a canned cycle", 'G');
      if (m.block_.hasOneShot && m.block_.oneShot != Function::Dwell)
        return refuse("a code that is no plain move", 'G');
      for (std::uint32_t i = 0; i < w.mCount; ++i) {
        const Function function = m.table_.m(w.m[i]).function;
        if (function == Function::ToolChange) return refuse("a tool change", 'M');
        // The control reads no farther than a stop.
        if (function == Function::Stop || function == Function::OptionalStop) queue.between += 2;
      }
      return true;
    }
  }
  if (!m.offsets_.active()) return true;
  if (!ends) return refuse("the begin", 'G');
  // Without a code of compensation the tool is still beside the path until it moves in the plane.
  const PlaneAxes& plane = kPlanes[queue.plane];
  const bool first = has(w, plane.first), second = has(w, plane.second);
  const bool moves = m.block_.hasOneShot ? m.block_.oneShot != Function::Dwell : m.modes_[kCanned] != 0;
  if (changed(kPlane) && m.modes_[kPlane] != queue.plane)
    return m.inconclusive(fmt::format("`G40` was given without a move: the tool is beside the path until it "
                                      "moves along {} or {}; move before another plane",
                                      kAxisLetters[plane.first], kAxisLetters[plane.second]),
                          'G');
  if (!moves) return true;
  const bool skips = m.block_.hasOneShot && m.block_.oneShot == Function::Skip;
  if (skips || first != second || (!first && m.modes_[kCanned] != 0))
    return m.inconclusive(fmt::format("`G40` was given without a move: the tool is beside the path; move "
                                      "along {} and {} before this",
                                      kAxisLetters[plane.first], kAxisLetters[plane.second]),
                          'G');
  if (first) finish();
  return true;
}

double OffsetWork::radiusOf(double d) const {
  const double kept = std::exchange(machine_.modalWords_[slotOf('D')], d);
  const double radius = machine_.offsetRadius();
  machine_.modalWords_[slotOf('D')] = kept;
  return radius;
}

void OffsetWork::finish() {
  if (machine_.trace_ != nullptr) machine_.trace_->hold(false);
  machine_.offsets_.queue_.reset();
}

// A block without a move in the plane, of which the control looks past one at least.
void OffsetWork::after(const NcWords& w) {
  OffsetQueue* const queue = machine_.offsets_.queue_.get();
  if (queue == nullptr || queue->moved || queue->waiting.empty()) return;
  if ((w.present & ~ir::addressBits("NO")) != 0 || w.gCount != 0 || w.mCount != 0) ++queue->between;
}

// G40, or the end of the program: the last move ends beside its end.
bool OffsetWork::leave() {
  OffsetQueue& queue = *machine_.offsets_.queue_;
  if (queue.stage == OffsetQueue::Stage::Begun) {
    // No move has followed the one at which it begins.
    const OffsetStep& lead = queue.waiting.front();
    emitWaiting(queue.at, plane(lead, true));
    finish();
    return machine_.running();
  }
  if (!queue.waiting.empty()) {
    const OffsetStep& lead = queue.waiting.front();
    const PlanePoint end = offsetEnd(lead.move, queue.radius);
    if (!fits(lead, queue.at, end)) return false;
    emitWaiting(queue.at, end);
    if (!machine_.running()) return false;
    queue.at = end;
  }
  queue.stage = OffsetQueue::Stage::Leaving;
  const PlaneAxes& axes = kPlanes[queue.plane];
  queue.vector = {queue.at.u - machine_.work_[axes.first], queue.at.v - machine_.work_[axes.second]};
  return true;
}

void OffsetWork::atEnd() {
  if (machine_.offsets_.queue_->stage != OffsetQueue::Stage::Leaving && !leave()) return;
  if (machine_.offsets_.active()) finish();
}

PlanePoint OffsetWork::plane(const OffsetStep& step, bool end) const {
  const PlaneAxes& axes = kPlanes[machine_.offsets_.queue_->plane];
  const Position& at = end ? step.to : step.from;
  return {at[axes.first], at[axes.second]};
}

// Between the ends that its corners have given it.
bool OffsetWork::fits(const OffsetStep& lead, PlanePoint begin, PlanePoint end) const {
  const double radius = machine_.offsets_.queue_->radius;
  const char* why = nullptr;
  if (lead.move.arc && offsetArcRadius(lead.move, radius) < 1e-6)
    why = "interference in cutter compensation: the radius of the arc is not larger than that of the tool";
  else if (goesBack(lead.move, begin, end))
    why =
        "interference in cutter compensation: the move is too short for the radius of the tool at an inside "
        "corner";
  return why == nullptr || raiseAt(lead, why);
}

// The block that runs is a later one.
bool OffsetWork::raiseAt(const OffsetStep& step, std::string_view why) const {
  std::uint64_t& line = machine_.stack_.back().line;
  const std::string place = step.line == line ? "" : fmt::format("; it is the move of line {}", step.line);
  line = step.line;
  return machine_.raiseUnnumbered(std::string(why) + place);
}

// The lead from `begin` to `end`, and what else waits, at its end.
void OffsetWork::emitWaiting(PlanePoint begin, PlanePoint end) {
  OffsetQueue& queue = *machine_.offsets_.queue_;
  const std::vector<OffsetStep> steps = std::exchange(queue.waiting, {});
  queue.between = 0;
  std::size_t grown = 0;
  for (std::size_t i = 0; i < steps.size() && machine_.running(); ++i) {
    OffsetStep step = steps[i];
    step.place += grown;
    grown += emit(step, i == 0 ? begin : end, end);
  }
}

// One motion; gives how much longer the trace is.
std::size_t OffsetWork::emit(const OffsetStep& step, PlanePoint begin, PlanePoint end) {
  Machine& m = machine_;
  const PlaneAxes& axes = kPlanes[m.offsets_.queue_->plane];
  const Position kept = m.work_;
  const auto modes = m.modes_;
  const double feed = m.feed_;
  const std::uint64_t line = m.stack_.back().line;
  const auto at = [&](Position position, PlanePoint point) {
    position[axes.first] = snap(point.u);
    position[axes.second] = snap(point.v);
    return position;
  };
  m.work_ = at(step.from, begin);
  const Position to = at(step.to, end);
  m.modes_[kMotion] = step.motion;
  m.modes_[kFeedMode] = step.feedMode;
  m.feed_ = step.feed;
  m.stack_.back().line = step.line;
  const std::size_t tail = m.trace_ != nullptr ? m.trace_->place() : 0;
  const std::uint64_t traced = m.trace_ != nullptr ? m.trace_->line() : 0;
  if (m.trace_ != nullptr) m.trace_->at(step.line);
  const std::uint32_t moved = step.axes | 1u << axes.first | 1u << axes.second;
  m.shown_ |= moved;
  if (isArc(step.motion) && (!isSame(begin, end) || isSame(step.move.from, step.move.to))) {
    m.arcTo(axes, to, moved, step.move.centre.u - m.work_[axes.first],
            step.move.centre.v - m.work_[axes.second]);
  } else {
    if (m.trace_ != nullptr)
      m.traceMove(step.motion == kRapid ? "rapid" : "feed", Machine::knownOf(to, m.uncertain_),
                  step.motion != kRapid);
    m.work_ = to;
    if (m.watcher_ != nullptr)
      m.tellMotion(step.motion == kRapid ? MotionKind::Rapid : MotionKind::Feed, moved);
  }
  std::size_t grown = 0;
  if (m.trace_ != nullptr) {
    grown = m.trace_->takeTo(std::min(step.place, tail), tail);
    m.trace_->at(traced);
  }
  m.modes_ = modes;
  m.feed_ = feed;
  if (!m.running()) return grown; // who watches has ended it there
  m.work_ = kept;
  m.stack_.back().line = line;
  return grown;
}

// A move of the program to `end`, `centre` of an arc from where it begins. false: the run has ended.
bool OffsetWork::move(const Position& end, std::uint32_t axes,
                      const std::optional<std::array<double, 2>>& centre) {
  using Stage = OffsetQueue::Stage;
  Machine& m = machine_;
  if (!m.offsets_.active()) {
    m.offsets_.queue_ = std::make_unique<OffsetQueue>();
    m.offsets_.queue_->plane = m.modes_[kPlane];
    m.offsets_.queue_->radius = m.offsetRadius();
  }
  OffsetQueue& queue = *m.offsets_.queue_;
  const PlaneAxes& plane = kPlanes[queue.plane];
  OffsetStep step;
  step.from = m.work_;
  step.to = end;
  step.motion = m.modes_[kMotion];
  step.feedMode = m.modes_[kFeedMode];
  step.feed = m.feed_;
  step.line = m.stack_.back().line;
  step.axes = axes;
  step.place = m.trace_ != nullptr ? m.trace_->place() : 0;
  step.move = {{m.work_[plane.first], m.work_[plane.second]}, {end[plane.first], end[plane.second]}};
  if (centre) {
    step.move.arc = true;
    step.move.clockwise = step.motion == kArcClockwise;
    step.move.centre = {step.move.from.u + (*centre)[0], step.move.from.v + (*centre)[1]};
  }
  const bool inPlane = centre || !isSame(step.move.from, step.move.to);
  if (queue.stage == Stage::Leaving) {
    if (centre && inPlane)
      return m.raiseUnnumbered("an arc at the end of cutter compensation: it ends with a straight move");
    const PlanePoint beside{m.work_[plane.first] + queue.vector.u, m.work_[plane.second] + queue.vector.v};
    // Along the axis beside the plane it goes where the tool is.
    const bool stays = !inPlane && (axes & (1u << plane.first | 1u << plane.second)) == 0;
    emit(step, beside, stays ? beside : step.move.to);
    m.work_ = end;
    if (!stays) finish();
    return m.running();
  }
  if (!inPlane) {
    m.work_ = end;
    if (queue.waiting.empty()) { // nothing has begun
      emit(step, step.move.to, step.move.to);
      finish();
      return m.running();
    }
    queue.waiting.push_back(step);
    return true;
  }
  if (!centre || queue.stage != Stage::Off) {
    if (!enter(step)) return false;
    m.work_ = end;
    if (m.trace_ != nullptr) {
      m.trace_->hold(true);
      step.place = m.trace_->place();
    }
    queue.waiting.push_back(step);
    queue.between = 0;
    queue.moved = true;
    return true;
  }
  return m.raiseUnnumbered("an arc at the begin of cutter compensation: it begins with a straight move");
}

// The corner between what waits and the next move in the plane.
bool OffsetWork::enter(const OffsetStep& next) {
  using Stage = OffsetQueue::Stage;
  Machine& m = machine_;
  OffsetQueue& queue = *m.offsets_.queue_;
  if (queue.stage == Stage::Off) {
    queue.stage = Stage::Begun;
    queue.at = next.move.from;
    return true;
  }
  const OffsetStep lead = queue.waiting.front();
  const bool begins = queue.stage == Stage::Begun;
  std::optional<OffsetCorner> corner;
  if (begins) {
    const PlanePoint at = offsetBegin(next.move, queue.radius);
    corner = OffsetCorner{at, false, {}, at};
  } else {
    corner = offsetCorner(lead.move, next.move, queue.radius, m.roundsCorners_);
  }
  if (next.move.arc && offsetArcRadius(next.move, queue.radius) < 1e-6)
    return fits(next, next.move.from, next.move.to);
  if (!corner) {
    return raiseAt(lead,
                   "no solution in cutter compensation: the offset moves of an inside corner do not meet");
  }
  if (queue.between > 1 && !isSame(corner->end, offsetEnd(lead.move, queue.radius), 1e-3))
    return m.inconclusive(
        "between this move and the one before in the plane of cutter compensation are several blocks that "
        "do not move in it: whether the control looks past them for the corner depends on a parameter (19625 "
        "on "
        "a Fanuc); leave one at most between them",
        'G');
  if (!begins && !fits(lead, queue.at, corner->end)) return false;
  const Position beside = queue.waiting.back().to;
  emitWaiting(queue.at, corner->end);
  OffsetStep link = next;
  link.from = link.to = beside;
  link.move.arc = corner->round;
  link.move.centre = lead.move.to;
  if (next.motion == kRapid && lead.motion != kRapid) link.feed = lead.feed, link.feedMode = lead.feedMode;
  link.motion = next.motion == kRapid && lead.motion == kRapid ? kRapid : kFeed;
  if (corner->round) link.motion = queue.radius > 0 ? kArcClockwise : kArcCounterClockwise;
  PlanePoint from = corner->end;
  for (const PlanePoint& to : corner->links) {
    if (!m.running()) return false;
    if (m.trace_ != nullptr) link.place = m.trace_->place();
    emit(link, from, to);
    from = to;
  }
  queue.at = corner->begin;
  queue.stage = Stage::On;
  return m.running();
}

} // namespace dotek::sim
