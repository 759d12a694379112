// What a cycle that runs by its meaning (sim/cycle) does to the machine, beside MachineMacros.cpp.
#include "sim/machine/Axes.h"
#include "sim/machine/Machine.h"
#include "sim/machine/Measurement.h"

#include <fmt/format.h>

namespace dotek::sim {

bool Machine::goTo(const Position& end, MotionKind kind, std::optional<double> feed) {
  if (uncertain_ != 0) return inconclusive("where the move begins is not known");
  const Position from = work_;
  std::uint32_t axes = 0;
  for (std::size_t i = 0; i < kAxes; ++i) {
    work_[i] = snap(end[i]);
    if (work_[i] != from[i]) axes |= 1u << i;
  }
  shown_ |= axes;
  if (feed) feed_ = *feed;
  moved_ = true;
  if (watcher_ != nullptr) tellMotion(kind, axes);
  if (trace_ != nullptr)
    traceMove(kind == MotionKind::Rapid ? "rapid" : "feed", knownPosition(), kind != MotionKind::Rapid);
  return running();
}

std::optional<Machine::WorkSystem> Machine::workSystem(double number) const {
  constexpr std::uint32_t kFirst = 54, kExtendedFirst = 5410;
  if (!(number >= kFirst && number < 1e6) ||
      number != static_cast<double>(static_cast<std::uint32_t>(number)))
    return std::nullopt;
  const auto whole = static_cast<std::uint32_t>(number);
  if (whole < kFirst + systems_.size()) return WorkSystem{whole - kFirst, false};
  if (whole <= kExtendedFirst || whole - kExtendedFirst >= extended_.size()) return std::nullopt;
  return WorkSystem{whole - kExtendedFirst, true};
}

Machine::WorkSystem Machine::activeSystem() const {
  if (modes_[kSystem] == kExtended) return {static_cast<std::uint32_t>(extendedNow_), true};
  return {modes_[kSystem], false};
}

std::string Machine::nameOf(const WorkSystem& system) {
  return system.extended ? fmt::format("G54.1 P{}", system.index) : fmt::format("G{}", 54 + system.index);
}

double Machine::offsetOf(const WorkSystem& system, std::size_t axis) const {
  return system.extended ? extended_[system.index][axis] : systems_[system.index][axis];
}

bool Machine::writeOffset(const WorkSystem& system, std::size_t axis, double value) {
  double& offset = (system.extended ? extended_[system.index] : systems_[system.index])[axis];
  const double after = snap(value);
  const std::string name = fmt::format("{} {}", nameOf(system), kAxisLetters[axis]);
  if (watcher_ != nullptr) watcher_->offsetWritten({name, offset, after});
  offset = after;
  if (trace_ != nullptr) trace_->begin("offset").text(name.substr(1)).word("", after).end();
  return applyOffsets();
}

void Machine::writeTool(std::uint32_t tool, bool radius, double value) {
  if (toolRadii_.size() <= tool) toolRadii_.resize(tool + 1);
  const double before = radius ? toolRadii_[tool] : toolLengthOf(tool), after = snap(value);
  const std::string name = fmt::format("tool {} {}", tool, radius ? "radius" : "length");
  if (watcher_ != nullptr) watcher_->offsetWritten({name, before, after});
  if (radius)
    toolRadii_[tool] = after;
  else
    setToolLength(tool, after);
  if (trace_ != nullptr)
    trace_->begin("tool-offset")
        .text(fmt::format("{} {}", tool, radius ? "radius" : "length"))
        .word("", after)
        .end();
}

bool Machine::selectSystem(const WorkSystem& system) {
  modes_[kSystem] = system.extended ? kExtended : static_cast<std::uint8_t>(system.index);
  if (system.extended) extendedNow_ = system.index;
  if (!applyOffsets()) return false;
  if (trace_ != nullptr)
    trace_->begin("system").text(nameOf(system).substr(1)).position(knownPosition(), shown_).end();
  return true;
}

void Machine::switchSpindle(std::uint8_t direction, std::optional<double> speed) {
  static constexpr std::string_view kNames[] = {"off", "cw", "ccw"};
  spindle_ = direction;
  if (speed) speed_ = *speed;
  if (trace_ != nullptr) trace_->begin("spindle").text(kNames[direction]).word("S", speed_).end();
}

void Machine::switchCoolant(Coolant coolant) {
  coolant_ = coolant;
  if (trace_ == nullptr) return;
  trace_->begin("coolant")
      .text(coolant == Coolant::Flood  ? "flood"
            : coolant == Coolant::Mist ? "mist"
                                       : "off")
      .end();
}

void Machine::dwellFor(double seconds) {
  advance(seconds);
  if (watcher_ != nullptr) watcher_->dwelled(seconds);
  if (trace_ != nullptr) trace_->begin("dwell").word("", seconds).end();
}

} // namespace dotek::sim
