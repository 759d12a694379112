// Motion: where a block ends, and what keeps the machine from getting there.
#include "sim/machine/Axes.h"
#include "sim/machine/Machine.h"
#include "sim/machine/MachineOffset.h"
#include "stdlib/CodeTitles.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <fmt/format.h>

namespace dotek::sim {

using ir::NcWords;
using stdlib::Alarm;
using stdlib::Function;

void Machine::traceMove(std::string_view action, const Position& end, bool feed) {
  trace_->begin(action).position(end, shown_);
  if (feed) trace_->word(modes_[kFeedMode] == 0 ? "F" : "FR", feed_);
  trace_->end();
}

void Machine::lose(std::uint32_t axes, std::string_view code) {
  uncertain_ |= axes;
  lostBy_ = code;
  lostLine_ = stack_.back().line;
}

bool Machine::goesToMachine() const {
  return block_.hasOneShot &&
         (block_.oneShot == Function::ReferenceReturn || block_.oneShot == Function::SecondReferenceReturn ||
          block_.oneShot == Function::MachineCoordinates);
}

std::string Machine::lostWhy() const {
  if (lostBy_.empty()) return "since no source says where the cycle before it ends";
  const std::string since =
      fmt::format("since `{}`{}", lostBy_, lostLine_ == 0 ? "" : fmt::format(" in line {}", lostLine_));
  if (lostBy_ == "G30")
    return since + ": the second reference point is not known; go to a place by G53 after it";
  if (lostBy_.starts_with("G4"))
    return since + ": whether the axis moves by the tool's length at once depends on a parameter; write a Z "
                   "word in that block";
  return since + ", under G43: whether the tool's length stays in force there depends on a parameter; write "
                 "G43 H and Z again after it, or G49 before it";
}

std::string Machine::lostText(std::uint32_t axes) const {
  if (lostBy_.empty()) return "";
  std::string letters;
  for (std::size_t i = 0; i < kAxes; ++i)
    if ((axes & uncertain_ & 1u << i) != 0)
      letters += fmt::format("{}{}", letters.empty() ? "" : ", ", kAxisLetters[i]);
  return fmt::format(": {} is lost since `{}`{}: {}; an absolute {} under `G90` {} settles it{}", letters,
                     lostBy_, lostLine_ == 0 ? "" : fmt::format(" in line {}", lostLine_),
                     lostBy_ == "G30" ? "the second reference point is not known"
                     : lostBy_.starts_with("G4")
                         ? "whether the axis moves by the tool's length at once depends on a parameter"
                         : "whether the tool's length stays in force there depends on a parameter",
                     letters,
                     lostLine_ != 0 && lostLine_ == stack_.back().line ? "in this block itself"
                                                                       : "before this block",
                     lostBy_ == "G53" || lostBy_ == "G28" ? ", or `G49` before that one" : "");
}

bool Machine::target(const NcWords& w, Position& end) {
  end = work_;
  const std::uint32_t unknown = uncertain_;
  for (std::size_t i = 0; i < kAxes; ++i) {
    if (!has(w, i)) continue;
    const bool incremental = isIncremental(i);
    const char letter = kAxisLetters[i];
    if (incremental && (uncertain_ >> i & 1) != 0)
      return inconclusive("the position of this axis is not known" + lostText(1u << i), letter);
    const double value = lengthOf(w, letter);
    if (!(std::abs(w.of(letter)) < widest_)) return raise(Alarm::TooManyDigits, letter);
    end[i] = incremental ? snap(work_[i] + value) : value;
    shown_ |= 1u << i;
    uncertain_ &= ~(1u << i);
    if ((afterRotation_ >> i & 1) == 0) continue;
    if (incremental && value != 0)
      return inconclusive(
          "the first move of an axis after `G69` is incremental; the manuals ask for an absolute "
          "one, as the control may count from where the program was in turned coordinates; write "
          "it under `G90`",
          letter);
    if (!incremental) afterRotation_ &= ~(1u << i);
  }
  return turnTarget(w, end, unknown);
}

bool Machine::move(const NcWords& w) {
  if (modes_[kMotion] >= kTurningCycle) return singleCycle(w);
  const bool onArc = isArc(modes_[kMotion]);
  const bool centre = (w.present & ir::addressBits("IJKR")) != 0;
  if ((w.present & kAxisBits) == 0 && !(onArc && centre)) return true;
  moved_ = true;
  if (!motionKnown() || (modes_[kMotion] != kRapid && !feedKnown())) return false;
  const std::uint32_t unknown = uncertain_;
  Position end;
  if (!target(w, end)) return false;
  if (modes_[kMotion] != kRapid && !(feed_ > 0)) return raise(Alarm::NoFeed);
  if (onArc) {
    const PlaneAxes& plane = kPlanes[modes_[kPlane]];
    if ((unknown & (1u << plane.first | 1u << plane.second)) != 0)
      return inconclusive("where the arc begins is not known", 'G');
    return arc(w, end);
  }
  if (offsetsPath()) {
    const PlaneAxes& plane = kPlanes[modes_[kPlane]];
    if ((unknown & (1u << plane.first | 1u << plane.second)) != 0)
      return inconclusive("where the move begins is not known, under cutter compensation" + lostText(unknown),
                          'G');
    return OffsetWork(*this).move(end, movedBy(w), std::nullopt);
  }
  if (trace_ != nullptr)
    traceMove(modes_[kMotion] == kRapid    ? "rapid"
              : modes_[kMotion] == kThread ? "thread"
                                           : "feed",
              knownOf(end, uncertain_), modes_[kMotion] != kRapid);
  work_ = end;
  if (watcher_ != nullptr)
    tellMotion(modes_[kMotion] == kRapid ? MotionKind::Rapid : MotionKind::Feed, movedBy(w));
  return true;
}

bool Machine::arc(const NcWords& w, const Position& end) {
  const PlaneAxes& plane = kPlanes[modes_[kPlane]];
  if (w.has(plane.unusedCentre)) return inconclusive("it is no address of this plane", plane.unusedCentre);
  double first = 0, second = 0; // from the start to the centre
  const double du = end[plane.first] - work_[plane.first];
  const double dv = end[plane.second] - work_[plane.second];
  if (w.has('R')) { // holds where I, J, K are beside it
    const double radius = lengthOf(w, 'R');
    const double chord = std::hypot(du, dv);
    if (radius == 0) return inconclusive("an arc of radius 0", 'R');
    if (chord == 0) return inconclusive("a full circle has no end that R could be measured from", 'R');
    double height = radius * radius - chord * chord / 4;
    if (height < 0) {
      // Half a circle, up to the tolerance.
      if (arcTolerance_ < 0 && chord / 2 - std::abs(radius) > 1e-6)
        return inconclusive("how far the radius may be off is not known", 'R');
      if (chord / 2 - std::abs(radius) > std::max(arcTolerance_, 1e-6)) return raise(Alarm::ArcRadius, 'R');
      height = 0;
    }
    height = std::sqrt(height);
    // The centre lies left of the chord for a counterclockwise arc of at most half a turn.
    const bool left = (modes_[kMotion] == kArcCounterClockwise) == (radius > 0);
    const double side = (left ? height : -height) / chord;
    first = du / 2 - dv * side;
    second = dv / 2 + du * side;
  } else {
    if (!w.has(plane.firstCentre) && !w.has(plane.secondCentre))
      return inconclusive("an arc without centre and radius", 'G');
    if (w.has(plane.firstCentre)) first = lengthOf(w, plane.firstCentre);
    if (w.has(plane.secondCentre)) second = lengthOf(w, plane.secondCentre);
    if (rotation_.on()) {
      const std::array<double, 2> way = rotation_.turnedWay(first, second);
      first = way[0];
      second = way[1];
    }
    const double difference = std::abs(std::hypot(first, second) - std::hypot(first - du, second - dv));
    if (arcTolerance_ < 0 && difference > control_->increment)
      return inconclusive("how far the radius may be off is not known", 'G');
    if (arcTolerance_ >= 0 && difference > arcTolerance_) return raise(Alarm::ArcRadius);
  }
  if (offsetsPath()) return OffsetWork(*this).move(end, movedBy(w), std::array<double, 2>{first, second});
  arcTo(plane, end, movedBy(w), first, second);
  return true;
}

void Machine::arcTo(const PlaneAxes& plane, const Position& end, std::uint32_t axes, double first,
                    double second) {
  if (trace_ != nullptr) {
    trace_->begin(modes_[kMotion] == kArcClockwise ? "arc-cw" : "arc-ccw").text(plane.name);
    trace_->position(knownOf(end, uncertain_), shown_);
    trace_->text("centre")
        .word("", snap(work_[plane.first] + first) * (plane.first == 0 && showsDiameters() ? 2 : 1))
        .word("", snap(work_[plane.second] + second) * (plane.second == 0 && showsDiameters() ? 2 : 1));
    trace_->word(modes_[kFeedMode] == 0 ? "F" : "FR", feed_).end();
  }
  const Position begin = work_;
  work_ = end;
  if (watcher_ != nullptr) tellArc(plane, axes, first, second, begin);
}

bool Machine::oneShot(const NcWords& w) {
  switch (block_.oneShot) {
  case Function::Dwell: return dwell(w);
  case Function::DataInput: return dataInput(w);
  case Function::LocalShift: return localShift(w);
  case Function::SetPosition: return setPosition(w);
  case Function::RotationOn: return rotationOn(w);
  case Function::MachineCoordinates: return machineMove(w);
  case Function::ReferenceReturn: return reference(w, true);
  case Function::SecondReferenceReturn: return reference(w, false);
  case Function::Skip: return skipMove(w);
  case Function::PeckAlongZ: return pecks(w, 2, 0);
  case Function::PeckAlongX: return pecks(w, 0, 2);
  case Function::ContourFinish:
  case Function::ContourRough:
  case Function::ThreadPasses: return refusedCycle(w);
  default: return inconclusive("what it does here is not known to Dotek", 'G');
  }
}

// G53: without axes it only waits for the moves before.
bool Machine::machineMove(const NcWords& w) {
  if ((w.present & kAxisBits) == 0) return true;
  if (!motionKnown() || (modes_[kMotion] == kFeed && !feedKnown())) return false;
  if (modes_[kDistance] != 0 || block_.increments != 0)
    return inconclusive("machine coordinates in incremental mode are not known", 'G');
  if (modes_[kMotion] > kFeed || modes_[kCanned] != 0)
    return inconclusive("machine coordinates go with rapid or feed", 'G');
  if (modes_[kMotion] == kFeed && !(feed_ > 0)) return raise(Alarm::NoFeed);
  moved_ = true;
  for (std::size_t i = 0; i < kAxes; ++i) {
    if (!has(w, i)) continue;
    const double value = lengthOf(w, kAxisLetters[i]);
    if (!(std::abs(w.of(kAxisLetters[i])) < widest_)) return raise(Alarm::TooManyDigits, kAxisLetters[i]);
    work_[i] = snap(value - offset_[i] - (i == 2 ? toolLength_ : 0));
    shown_ |= 1u << i;
    uncertain_ &= ~(1u << i);
    // Whether the tool's length stays in force depends on a parameter.
    if (i == 2 && toolLength_ != 0 && !keepsLength_) lose(1u << 2, "G53");
  }
  movedInMachine(axisNumbers(w.present & kAxisBits));
  if (trace_ != nullptr) {
    Position at = knownMachinePosition();
    for (std::size_t i = 0; i < kAxes; ++i)
      if (has(w, i)) at[i] = machinePosition()[i];
    traceMove(modes_[kMotion] == kRapid ? "machine rapid" : "machine feed", at, modes_[kMotion] != kRapid);
  }
  if (watcher_ == nullptr) return true;
  lengthInDoubt_ = false;
  tellMotion(modes_[kMotion] == kRapid ? MotionKind::Rapid : MotionKind::Feed,
             axisNumbers(w.present & kAxisBits));
  lengthInDoubt_ = (uncertain_ >> 2 & 1) != 0;
  return true;
}

// G28: through a point to the reference point, which is the zero of the machine. G30: its points are not
// known.
bool Machine::reference(const NcWords& w, bool first) {
  if (modes_[kCanned] != 0) return inconclusive("a reference return within a canned cycle", 'G');
  if (modes_[kComp] != 0) return inconclusive("a reference return under cutter compensation", 'G');
  if (w.has('P') && !(w.of('P') >= 2 && w.of('P') <= 4))
    return inconclusive("reference points are P2 to P4", 'P');
  if ((w.present & kAxisBits) == 0) {
    const Code* const code = table_.find(first ? Function::ReferenceReturn : Function::SecondReferenceReturn);
    const stdlib::CodeInfo* const info = code == nullptr ? nullptr : control_->find('G', code->tenths);
    if (info == nullptr || !stdlib::returnsAllAxes(*info))
      return inconclusive(
          "a reference return without axes: some controls move all axes, others none; name the axes", 'G');
    NcWords all = w; // each straight to its reference point
    for (std::size_t i = 0; i < kAxes; ++i) {
      if ((i >= 3 || turning_ != nullptr) && (shown_ >> i & 1) == 0) continue;
      all.present |= ir::addressBit(kAxisLetters[i]);
      all.value[slotOf(kAxisLetters[i])] = 0;
      block_.increments |= 1u << i;
    }
    return reference(all, first);
  }
  moved_ = true;
  Position via;
  const std::uint32_t unknown = uncertain_;
  for (std::size_t i = 0; i < kAxes; ++i) {
    // Whether the point on the path is turned is in no source.
    if (has(w, i) && rotation_.turns(i) && !(isIncremental(i) && w.of(kAxisLetters[i]) == 0))
      return refuseTurned("a reference return by way of another point");
    // From an unknown place straight to the reference point: the path is not known either, its end is.
    if (has(w, i) && (unknown >> i & 1) != 0 && isIncremental(i) && w.of(kAxisLetters[i]) == 0)
      uncertain_ &= ~(1u << i);
  }
  if (!target(w, via)) return false;
  if (watcher_ != nullptr) {
    // In incremental mode the point counts from where the machine is, whatever its coordinates are.
    Position to = at_;
    std::uint32_t lost = lost_;
    for (std::size_t i = 0; i < kAxes; ++i) {
      if (!has(w, i)) continue;
      if (isIncremental(i)) {
        to[i] = snap(at_[i] + lengthOf(w, kAxisLetters[i]));
      } else {
        to[i] = snap(via[i] + offset_[i] + (i == 2 ? toolLength_ : 0));
        lost = (lost & ~(1u << i)) | (i == 2 && lengthInDoubt_ ? 1u << 2 : 0);
      }
    }
    if (to != at_ || lost != lost_) tellTo(MotionKind::Rapid, to, lost);
    if (!running()) return true;
  }
  for (std::size_t i = 0; i < kAxes; ++i) {
    if (!has(w, i)) continue;
    work_[i] = snap(-offset_[i] - (i == 2 ? toolLength_ : 0));
    // Whether the tool's length stays in force depends on a parameter.
    if (!first || (i == 2 && toolLength_ != 0 && !keepsLength_)) lose(1u << i, first ? "G28" : "G30");
  }
  movedInMachine(axisNumbers(w.present & kAxisBits));
  if (trace_ != nullptr) {
    std::string axes;
    for (std::size_t i = 0; i < kAxes; ++i)
      if (has(w, i)) axes += kAxisLetters[i];
    trace_->begin(first ? "reference" : "second-reference").text(axes).text("via");
    const std::uint32_t named =
        modes_[kDistance] != 0 ? 0 : axisNumbers(w.present & kAxisBits) & ~block_.increments;
    trace_->position(knownOf(via, unknown & ~named), shown_).end();
  }
  if (watcher_ == nullptr || !running()) return true;
  const bool doubt = lengthInDoubt_ || (has(w, 2) && toolLength_ != 0 && !keepsLength_);
  lengthInDoubt_ = false;
  tellMotion(MotionKind::Rapid, axisNumbers(w.present & kAxisBits), first);
  lengthInDoubt_ = doubt;
  return true;
}

bool Machine::skipMove(const NcWords& w) {
  if ((w.present & kAxisBits) == 0) return true;
  if (modes_[kCanned] != 0 || modes_[kComp] != 0)
    return inconclusive("a skip move within a canned cycle or under cutter compensation", 'G');
  if (uncertain_ != 0) return inconclusive("where the move begins is not known" + lostText(uncertain_), 'G');
  const bool feeds = !dialect_.skipsAtOwnSpeed;
  Position end;
  if (!target(w, end) || (feeds && !feedKnown())) return false;
  if (feeds && !(feed_ > 0)) return raise(Alarm::NoFeed);
  moved_ = true;
  if (skip_ == nullptr) {
    const auto own = std::find_if(w.g.begin(), w.g.begin() + w.gCount, [&](std::uint32_t code) {
      return table_.g(code).function == Function::Skip;
    });
    return inconclusive(
        "no part is given, so whether the probe touches is not known; `--part PART.toml --machine "
        "MACHINE.toml` give one and a probe, or `--part PART.toml --tool 1 --length L --diameter D`",
        'G', own == w.g.begin() + w.gCount ? 0 : static_cast<std::uint32_t>(own - w.g.begin()));
  }
  SkipMove skip;
  skip.from = work_;
  skip.to = end;
  skip.machineFrom = machinePosition();
  skip.feed = feed_;
  skip.positions = skipPositions_;
  work_ = end;
  skip.machineTo = machinePosition();
  const std::optional<double> share = skip_->contact(skip);
  constexpr double kPressed = 1e-9; // share of a move within which the contact is there from the start
  lastSkip_ = !share ? Skip::Missed : *share <= kPressed ? Skip::Pressed : Skip::Touched;
  touched_ = touched_ || share;
  if (share && *share >= 0 && *share <= 1) {
    for (std::size_t i = 0; i < kAxes; ++i)
      work_[i] = snap(skip.from[i] + (end[i] - skip.from[i]) * *share);
  }
  skipped_ = work_; // without a contact the end of the block
  const double way = std::sqrt((end[0] - skip.from[0]) * (end[0] - skip.from[0]) +
                               (end[1] - skip.from[1]) * (end[1] - skip.from[1]) +
                               (end[2] - skip.from[2]) * (end[2] - skip.from[2]));
  // The axes brake on their way, and no farther than it leads.
  const double braking = lastSkip_ == Skip::Touched ? std::min(stopsBeyond_, way * (1 - *share)) : 0;
  for (std::size_t i = 0; i < kAxes; ++i)
    beyond_[i] = way > 0 ? braking * (end[i] - skip.from[i]) / way : 0;
  skippedTurned_ = rotation_.turnedBack(work_);
  if (rotation_.on()) {
    // The program's next words count from where the machine stopped.
    rotation_.tell(rotation_.first(), skippedTurned_[rotation_.first()]);
    rotation_.tell(rotation_.second(), skippedTurned_[rotation_.second()]);
  }
  if (watcher_ != nullptr) tellMotion(MotionKind::Skip, movedBy(w));
  if (trace_ != nullptr) {
    trace_->begin("skip").position(end, shown_);
    if (feeds) trace_->word("F", feed_);
    trace_->text(share ? "contact" : "no-contact").position(work_, shown_).end();
  }
  return true;
}

const Code* Machine::cannedCode() const {
  for (std::uint32_t group = 0; group < kGroups; ++group) {
    const Code& one = table_.g(groups_[group]);
    if (one.slot == kCanned && one.value != 0 && one.group == group) return &one;
  }
  return nullptr;
}

// G73 to G89. Only their ends are followed: over the hole, at the initial level or at level R.
bool Machine::cannedCycle(const NcWords& w) {
  const PlaneAxes& plane = kPlanes[modes_[kPlane]];
  const std::size_t depth = plane.third;
  const bool begins = (block_.slots >> kCanned & 1) != 0;
  if ((block_.slots >> kPlane & 1) != 0 && !begins)
    return inconclusive("another plane within a canned cycle", 'G');
  if (begins && !hasDepth_) {
    if ((uncertain_ >> depth & 1) != 0) return inconclusive("the initial level is not known", 'G');
    initialLevel_ = work_[depth];
  }
  const std::uint32_t drills = (w.present & kAxisBits) | (w.present & ir::addressBit('R'));
  if (!cyclePeck(w)) return false;
  if (drills == 0) return true;
  moved_ = true;
  const bool incremental = modes_[kDistance] != 0;
  Position hole;
  const double level = work_[depth];
  const std::uint32_t unknown = uncertain_, shown = shown_;
  const Rotation turned = rotation_;
  if (!target(w, hole) || !feedKnown()) return false;
  if (!(feed_ > 0)) return raise(Alarm::NoFeed);
  if (w.has('R')) {
    cycleR_ = incremental ? snap(initialLevel_ + lengthOf(w, 'R')) : lengthOf(w, 'R');
    hasR_ = true;
  }
  if (!hasR_) return inconclusive("a canned cycle without a level R", 'G');
  if (has(w, depth)) {
    const double value = lengthOf(w, kAxisLetters[depth]);
    cycleDepth_ = incremental ? snap(cycleR_ + value) : value;
    hasDepth_ = true;
  }
  if (!hasDepth_) return inconclusive("a canned cycle without a depth", 'G');
  double repeats = 1;
  if (control_->repeatLetter != 0 && w.has(control_->repeatLetter)) repeats = w.of(control_->repeatLetter);
  if (repeats == 0) { // R, depth and feed are kept, and nothing moves
    uncertain_ = unknown;
    shown_ = shown;
    rotation_ = turned;
    moved_ = false;
    return true;
  }
  if (!(repeats >= 1 && repeats <= 9999) || repeats != std::floor(repeats))
    return inconclusive("how the cycle repeats is not known", control_->repeatLetter);
  if (modes_[kCanned] == 2 && modes_[kReturn] != 0)
    return inconclusive("back boring returns to the initial level only", 'G');
  // In incremental mode each repeat is a step further.
  const Position start = work_;
  hole[depth] = level;
  for (int i = 1; i <= static_cast<int>(repeats); ++i) {
    Position at = hole;
    for (std::size_t axis = 0; incremental && axis < kAxes; ++axis)
      if (axis != depth) at[axis] = snap(start[axis] + (hole[axis] - start[axis]) * i);
    at[depth] = modes_[kReturn] == 0 ? initialLevel_ : cycleR_;
    if (trace_ != nullptr) {
      const Code* const code = cannedCode();
      trace_->begin("cycle").text(code == nullptr ? "?" : fmt::format("G{}", code->tenths / 10));
      Position bottom = at;
      bottom[depth] = cycleDepth_;
      trace_->position(knownOf(bottom, uncertain_), shown_).word("R", cycleR_);
      if (cyclePeck_ > 0) trace_->word("Q", cyclePeck_);
      if (cycleDwell_ > 0) trace_->word("P", cycleDwell_);
      trace_->word("F", feed_).text("ends").position(knownOf(at, uncertain_), shown_).end();
    }
    if (watcher_ != nullptr) {
      tellHole(at, movedBy(w), depth);
      if (!running()) return false;
    }
    seconds_ += cycleDwell_;
    work_ = at;
  }
  return true;
}

// Q is how deep a peck goes, P the dwell at the bottom; both stay in force until the cycle ends.
bool Machine::cyclePeck(const NcWords& w) {
  if (w.has('Q')) cyclePeck_ = std::abs(lengthOf(w, 'Q'));
  if (!w.has('P') || (block_.slots >> kSystem & 1) != 0) return true;
  const double value = w.of('P');
  if (!(value >= 0)) return inconclusive("a dwell is not below 0", 'P');
  const bool seconds = control_->dwellLetter == 'P' && (w.pointed & ir::addressBit('P')) != 0;
  cycleDwell_ = seconds ? value : value / 1000;
  return true;
}

} // namespace dotek::sim
