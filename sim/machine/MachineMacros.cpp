// What a macro that runs by its meaning does to the machine.
#include "sim/machine/Axes.h"
#include "sim/machine/Machine.h"

namespace dotek::sim {
namespace {

std::uint32_t changed(const Position& from, const Position& to) {
  std::uint32_t out = 0;
  for (std::size_t i = 0; i < kAxes; ++i)
    if (from[i] != to[i]) out |= 1u << i;
  return out;
}

} // namespace

void Machine::switchProbe(bool on) {
  probe_ = on ? Probe::On : Probe::Off;
  if (watcher_ != nullptr) watcher_->probeSwitched(on);
  if (trace_ != nullptr) trace_->begin("probe").text(on ? "on" : "off").end();
}

std::optional<bool> Machine::probeTo(const Position& end, bool positions, std::string_view action) {
  if (skip_ == nullptr) {
    inconclusive(
        "no part is given, so whether the probe touches is not known; `--part PART.toml --machine "
        "MACHINE.toml` give one and a probe, or `--part PART.toml --tool 1 --length L --diameter D`");
    return std::nullopt;
  }
  if (uncertain_ != 0) {
    inconclusive("where the move begins is not known");
    return std::nullopt;
  }
  SkipMove skip;
  skip.from = work_;
  skip.machineFrom = machinePosition();
  skip.feed = feed_;
  skip.positions = positions;
  for (std::size_t i = 0; i < kAxes; ++i)
    work_[i] = skip.to[i] = snap(end[i]);
  skip.machineTo = machinePosition();
  const std::optional<double> share = skip_->contact(skip);
  const bool contact = share && *share >= 0 && *share <= 1;
  if (contact) {
    for (std::size_t i = 0; i < kAxes; ++i)
      work_[i] = snap(skip.from[i] + (skip.to[i] - skip.from[i]) * *share);
  }
  lastSkip_ = contact ? Skip::Touched : Skip::Missed;
  touched_ = touched_ || contact;
  beyond_ = {};
  skipped_ = skippedTurned_ = work_; // macros by their meaning do not run under G68
  if (watcher_ != nullptr) tellMotion(MotionKind::Skip, changed(skip.from, work_));
  if (trace_ != nullptr) {
    trace_->begin(action).position(skip.to, shown_).text(contact ? "contact" : "no-contact");
    trace_->position(work_, shown_).end();
  }
  if (!running()) return std::nullopt; // who watches has ended it
  return contact;
}

bool Machine::travelTo(const Position& end) {
  if (uncertain_ != 0) return inconclusive("where the move begins is not known");
  const Position from = work_;
  for (std::size_t i = 0; i < kAxes; ++i)
    work_[i] = snap(end[i]);
  if (watcher_ != nullptr) tellMotion(MotionKind::Feed, changed(from, work_));
  if (trace_ != nullptr) trace_->begin("travel").position(work_, shown_).end();
  return running();
}

void Machine::forget(std::uint32_t number) {
  const std::uint32_t cell = layout_.cellOf(number);
  if (cell == CellLayout::kNone) return;
  cells_[cell] = kUnknown;
  hasUnknown_ = true;
}

void Machine::forgetMotion(std::optional<double> feed) {
  motionForgotten_ = true;
  feedForgotten_ = !feed;
  if (feed) feed_ = *feed;
  long_ = 1;
}

bool Machine::motionKnown() {
  return !motionForgotten_ ||
         inconclusive("which motion is in force after the call is not known; `G0` or `G1` says it");
}

bool Machine::feedKnown() {
  return !feedForgotten_ || inconclusive("which feed is in force after the call is not known; `F` says it");
}

void Machine::remark(std::string_view action, std::string_view text) {
  if (trace_ != nullptr) trace_->begin(action).text(text).end();
}

bool Machine::raiseUnnumbered(std::string_view text) {
  stop(Ending::Alarm);
  end_.number = 0;
  end_.text = text;
  end_.letter = 0;
  end_.stack = stack_;
  if (trace_ != nullptr) trace_->begin("alarm").text("?").text(end_.text).end();
  return false;
}

} // namespace dotek::sim
