// G68 and G69. The machine keeps its position in the work system as it is; words of a program are turned when
// they are read. Manuals: Fanuc B-62764EN 354, B-63324EN 470, B-63503EN 602 (parameters 5400 and 5410).
#include "sim/machine/Axes.h"
#include "sim/machine/Machine.h"

#include <array>
#include <cmath>
#include <fmt/format.h>

namespace dotek::sim {

using ir::NcWords;
using stdlib::RotationFacts;

namespace {

constexpr double kSame = 1e-6; // mm

bool same(double a, double b) {
  return std::abs(a - b) <= kSame; // false for a NaN
}

} // namespace

bool Machine::refuseTurned(std::string_view what) {
  return inconclusive(fmt::format("{} while `G68` turns the coordinates: the manuals do not allow it; `G69` "
                                  "before it ends the rotation",
                                  what));
}

// Degrees, rounded to a thousandth.
std::optional<double> Machine::rotationAngle(const NcWords& w) {
  if (!w.has('R')) {
    inconclusive("a rotation without `R` takes its angle from a parameter (5410 on a Fanuc); write `R`", 'G');
    return std::nullopt;
  }
  const bool bare = (needPoint_ & ~w.pointed & ir::addressBit('R')) != 0;
  const double angle = rounded(bare ? w.of('R') / 1000 : w.of('R'), 3);
  if (!(std::abs(angle) <= 360)) {
    inconclusive("an angle is from -360 to 360 degrees", 'R');
    return std::nullopt;
  }
  if (modes_[kDistance] != 0 && rotation_.on()) {
    inconclusive("under `G91` a parameter (5400#0 on a Fanuc) says whether the angle adds to the one before; "
                 "write `G90` with it",
                 'R');
    return std::nullopt;
  }
  return angle;
}

bool Machine::rotationOn(const NcWords& w) {
  const PlaneAxes& plane = kPlanes[modes_[kPlane]];
  const std::array<std::size_t, 2> axes{plane.first, plane.second};
  const bool spatial = (w.present & ir::addressBits("IJK")) != 0;
  if (modes_[kComp] != 0 || modes_[kCanned] != 0)
    return inconclusive("a rotation that begins under cutter compensation or in a canned cycle", 'G');
  if (spatial) {
    // About Z through the zero it is a rotation in XY, however its zero is counted.
    bool plain = modes_[kPlane] == 0 && w.of('I') == 0 && w.of('J') == 0 && w.has('K') && w.of('K') == 1;
    for (std::size_t i = 0; i < 3; ++i)
      plain = plain && has(w, i) == has(w, 0) && (!has(w, i) || w.of(kAxisLetters[i]) == 0);
    if (!plain || !has(w, 0))
      return inconclusive("with I, J, K it turns in space; Dotek follows that about Z through X0 Y0 Z0 alone",
                          'G');
  }
  for (std::size_t i = 0; i < kAxes; ++i)
    if (has(w, i) && i != axes[0] && i != axes[1] && !(spatial && i == 2))
      return inconclusive("the centre of a rotation lies in the plane", kAxisLetters[i]);
  const std::optional<double> angle = rotationAngle(w);
  if (!angle) return false;
  if (has(w, axes[0]) != has(w, axes[1]))
    return inconclusive(
        fmt::format("of the centre of rotation {} is missing; write both, or none for where the "
                    "tool is",
                    kAxisLetters[has(w, axes[0]) ? axes[1] : axes[0]]),
        'G');
  std::array<double, 2> centre{};
  for (std::size_t n = 0; n < 2; ++n) {
    if (has(w, axes[n])) {
      // Absolute under G91, too.
      centre[n] = lengthOf(w, kAxisLetters[axes[n]]);
      if (!(std::abs(w.of(kAxisLetters[axes[n]])) < widest_))
        return raise(stdlib::Alarm::TooManyDigits, kAxisLetters[axes[n]]);
      continue;
    }
    if ((uncertain_ >> axes[n] & 1) != 0)
      return inconclusive("the centre is where the tool is, and that is not known", 'G');
    if (rotation_.on())
      return inconclusive("the centre of a rotation within a rotation is not known; write it", 'G');
    centre[n] = work_[axes[n]];
  }
  rotation_ = Rotation::about(axes[0], axes[1], centre, *angle, work_);
  if (trace_ != nullptr) {
    trace_->begin("rotation").text(plane.name).word("", *angle).text("centre");
    trace_->word("", centre[0]).word("", centre[1]).end();
  }
  return true;
}

void Machine::rotationOff() {
  if (!rotation_.on()) return;
  for (const std::size_t axis : {rotation_.first(), rotation_.second()})
    if (const double told = rotation_.told(axis); !std::isnan(told) && !same(told, work_[axis]))
      afterRotation_ |= 1u << axis;
  rotation_ = {};
  if (trace_ != nullptr) trace_->begin("rotation").text("off").end();
}

std::uint32_t Machine::movedBy(const NcWords& w) const {
  std::uint32_t axes = axisNumbers(w.present & kAxisBits);
  if (!rotation_.on()) return axes;
  const std::uint32_t plane = 1u << rotation_.first() | 1u << rotation_.second();
  return (axes & plane) != 0 ? axes | plane : axes;
}

void Machine::movedInMachine(std::uint32_t axes) {
  afterRotation_ &= ~axes;
  if (rotation_.on() && (axes & (1u << rotation_.first() | 1u << rotation_.second())) != 0)
    rotation_.forget();
}

// `end` comes with the words as they are written.
bool Machine::turnTarget(const NcWords& w, Position& end, std::uint32_t unknown) {
  if (!rotation_.on()) return true;
  const std::array<std::size_t, 2> axes{rotation_.first(), rotation_.second()};
  const std::array<bool, 2> named{has(w, axes[0]), has(w, axes[1])};
  if (!named[0] && !named[1]) return true;
  if (modes_[kDistance] != 0) {
    const std::array<double, 2> way = rotation_.turnedWay(named[0] ? end[axes[0]] - work_[axes[0]] : 0,
                                                          named[1] ? end[axes[1]] - work_[axes[1]] : 0);
    for (std::size_t n = 0; n < 2; ++n) {
      if ((unknown >> axes[n] & 1) != 0)
        return inconclusive("the position of this axis is not known", kAxisLetters[axes[n]]);
      rotation_.tell(axes[n], snap(rotation_.told(axes[n]) + (end[axes[n]] - work_[axes[n]])));
      end[axes[n]] = snap(work_[axes[n]] + way[n]);
    }
    return true;
  }
  for (std::size_t n = 0; n < 2; ++n) {
    if (named[n]) continue;
    const std::size_t axis = axes[n];
    if ((unknown >> axis & 1) != 0 || (unknown >> axes[1 - n] & 1) != 0)
      return inconclusive("the position of this axis is not known, and under `G68` both move",
                          kAxisLetters[axis]);
    const double turned = rotation_.turnedBack(work_)[axis], asBefore = rotation_.told(axis);
    double value = turned;
    if (!same(turned, asBefore)) {
      switch (control_->rotation.otherAxis) {
      case RotationFacts::Position::Turned: break;
      case RotationFacts::Position::AsBefore:
        if (!std::isnan(asBefore)) {
          value = asBefore;
          break;
        }
        [[fallthrough]];
      case RotationFacts::Position::Unknown:
        return inconclusive(fmt::format("the first move after `G68` names {} alone, and where {} then goes "
                                        "depends on a parameter (11600#5 on a Fanuc); write both axes",
                                        kAxisLetters[axes[1 - n]], kAxisLetters[axis]),
                            kAxisLetters[axes[1 - n]]);
      }
    }
    end[axis] = value;
  }
  for (const std::size_t axis : axes)
    rotation_.tell(axis, end[axis]);
  end = rotation_.turned(end);
  for (const std::size_t axis : axes)
    shown_ |= 1u << axis;
  return true;
}

std::optional<double> Machine::turnedVariable(std::uint32_t number, std::size_t axis, const Position& work,
                                              const Position& latched) {
  switch (control_->rotation.positions) {
  case RotationFacts::Frame::Work: return work[axis];
  case RotationFacts::Frame::Program: return latched[axis];
  case RotationFacts::Frame::Unknown: break;
  }
  if (same(work[axis], latched[axis]) &&
      (!rotation_.turns(axis) || same(work[axis], rotation_.turnedBack(work)[axis])))
    return work[axis];
  inconclusive(
      fmt::format("#{} is read of a position under `G68`, and whether it counts in the turned coordinates "
                  "no source says; `G69` before the move that it is about settles it (`[rotation]` of the "
                  "control's file, too)",
                  number));
  return std::nullopt;
}

} // namespace dotek::sim
