// What a block sets: feed, spindle, coolant, tool, offsets, systems of coordinates.
#include "sim/machine/Axes.h"
#include "sim/machine/Machine.h"
#include "sim/machine/MachineOffset.h"
#include "sim/machine/Measurement.h"
#include "sim/machine/Place.h"
#include "sim/machine/Refusals.h"
#include "stdlib/RadiusOffsets.h"

#include <cmath>
#include <fmt/format.h>

namespace dotek::sim {

using ir::NcWords;
using stdlib::Alarm;
using stdlib::Function;

namespace {

// A word that counts: whole, from 0.
std::optional<std::uint32_t> whole(const NcWords& w, char letter) {
  const double value = w.of(letter);
  if (!(value >= 0 && value < 1e9) || value != std::floor(value)) return std::nullopt;
  return static_cast<std::uint32_t>(value);
}

} // namespace

// Half away from zero; a value that a decimal text would put on the half counts as one.
double Machine::rounded(double value, int places) const {
  static constexpr double kPowers[] = {1, 10, 100, 1e3, 1e4, 1e5, 1e6, 1e7};
  const double power = kPowers[places];
  const double scaled = std::abs(value) * power;
  if (!(scaled < 1e15)) return value;
  const double units = std::floor(scaled + 0.5 + 1e-7);
  return std::copysign(units / power, value) + 0.0; // no -0
}

double Machine::lengthOf(const NcWords& w, char letter) const {
  const double value = w.of(letter);
  const bool linear = (ir::addressBit(letter) & kRotaryBits) == 0;
  const bool inch = linear && modes_[kUnits] != 0;
  const int places = control_->decimals + (inch ? 1 : 0);
  const bool bare = (needPoint_ & ~w.pointed & ir::addressBit(letter)) != 0;
  double out = value;
  if (bare) {
    double increments = 1;
    for (int i = 0; i < places; ++i)
      increments *= 10;
    out = value / increments;
  }
  if (bare || w.mostPlaces > static_cast<std::uint32_t>(places)) out = rounded(out, places);
  if (letter == 'X' && countsDiameters()) out /= 2;
  return inch ? snap(out * kInch) : out;
}

bool Machine::settings(const NcWords& w) {
  const bool limitsSpeed = limitsSpindle(w);
  for (const char letter : {'B', 'D', 'H', 'T', 'S'})
    if (w.has(letter) && !(letter == 'S' && limitsSpeed)) modalWords_[slotOf(letter)] = w.of(letter);
  if (w.has('F')) {
    const bool bare =
        control_->decimal == stdlib::DecimalMode::Increment && (w.pointed & ir::addressBit('F')) == 0;
    if (bare && (modes_[kFeedMode] != 0 || modes_[kUnits] != 0))
      return inconclusive("what it counts without a point is not known", 'F');
    if (!(w.of('F') >= 0)) return inconclusive("a feed is not below 0", 'F');
    feed_ = modes_[kUnits] != 0 ? snap(w.of('F') * kInch) : w.of('F');
    feedForgotten_ = false;
  }
  if (w.has('S')) {
    if (!(w.of('S') >= 0)) return inconclusive("a speed is not below 0", 'S');
    if (!limitsSpeed) speed_ = w.of('S');
  }
  if (w.has('T')) {
    const std::optional<std::uint32_t> tool = whole(w, 'T');
    if (!tool) return inconclusive("it is no tool number", 'T');
    if (turning_ != nullptr) {
      if (!takesTool(*tool)) return false;
    } else {
      toolNumber_ = *tool;
      if (trace_ != nullptr) trace_->begin("tool").text(std::to_string(toolNumber_)).end();
    }
  }
  if (trace_ != nullptr && modes_[kSurface] != block_.before[kSurface])
    trace_->begin("surface-speed").text(modes_[kSurface] != 0 ? "on" : "off").end();
  if (trace_ != nullptr && modes_[kComp] != block_.before[kComp]) {
    static constexpr std::string_view kNames[] = {"off", "left", "right"};
    trace_->begin("comp").text(kNames[modes_[kComp]]);
    if (modes_[kComp] != 0 && !dialect_.firstParameter)
      trace_->text(fmt::format("D{:.0f}", modalWords_[slotOf('D')]));
    trace_->end();
  }
  return true;
}

bool Machine::miscellaneous(const NcWords& w) {
  bool spindle = w.has('S') && !limitsSpindle(w);
  for (std::uint32_t i = 0; trace_ != nullptr && i < w.gCount; ++i)
    if (table_.g(w.g[i]).function == Function::Auxiliary)
      trace_->begin("auxiliary").text(codeName('G', w.g[i])).end();
  for (std::uint32_t i = 0; i < w.mCount; ++i) {
    modalWords_[slotOf('M')] = w.m[i];
    std::string_view action, state;
    switch (table_.m(w.m[i]).function) {
    case Function::SpindleClockwise:
      spindle_ = 1;
      spindle = true;
      break;
    case Function::SpindleCounterClockwise:
      spindle_ = 2;
      spindle = true;
      break;
    case Function::SpindleOff:
      spindle_ = 0;
      spindle = true;
      break;
    case Function::CoolantMist: action = "coolant", state = "mist", coolant_ = Coolant::Mist; break;
    case Function::CoolantFlood: action = "coolant", state = "flood", coolant_ = Coolant::Flood; break;
    case Function::CoolantOff: action = "coolant", state = "off", coolant_ = Coolant::Off; break;
    case Function::ProbeOn: switchProbe(true); break;
    case Function::ProbeOff: switchProbe(false); break;
    case Function::ToolChange:
      if (trace_ != nullptr) trace_->begin("tool-change").text(std::to_string(toolNumber_)).end();
      if (watcher_ != nullptr) watcher_->toolChanged(toolNumber_);
      break;
    case Function::Auxiliary:
      if (trace_ != nullptr) trace_->begin("auxiliary").text(fmt::format("M{}", w.m[i])).end();
      if (watcher_ != nullptr) watcher_->auxiliary(w.m[i]);
      break;
    default: break;
    }
    if (trace_ != nullptr && !action.empty()) trace_->begin(action).text(state).end();
  }
  if (spindle && trace_ != nullptr && (spindle_ != shownSpindle_ || speed_ != shownSpeed_)) {
    shownSpindle_ = spindle_;
    shownSpeed_ = speed_;
    static constexpr std::string_view kNames[] = {"off", "cw", "ccw"};
    trace_->begin("spindle").text(kNames[spindle_]).word(modes_[kSurface] != 0 ? "V" : "S", speed_).end();
  }
  return true;
}

// After the motion of the block.
bool Machine::stops(const NcWords& w) {
  for (std::uint32_t i = 0; i < w.mCount; ++i) {
    switch (table_.m(w.m[i]).function) {
    case Function::Stop: pause(""); break;
    case Function::OptionalStop:
      if (trace_ != nullptr) trace_->begin("optional-stop").end();
      if (watcher_ != nullptr) watcher_->auxiliary(w.m[i]);
      break;
    case Function::ProgramEnd:
    case Function::Return:
      if (table_.m(w.m[i]).function == Function::Return) return stop(Ending::Return);
      if (offsets_.active()) OffsetWork(*this).atEnd();
      if (!running()) return false;
      if (trace_ != nullptr) trace_->begin("end").end();
      return stop(Ending::ProgramEnd);
    default: break;
    }
  }
  return true;
}

void Machine::updateOffsets() {
  const Position& system = systemOffset();
  for (std::size_t i = 0; i < kAxes; ++i) {
    const double now = snap(external_[i] + system[i] + local_[i] + shift_[i]);
    if (now == offset_[i]) continue;
    // The machine is still; its coordinates change.
    work_[i] = snap(work_[i] + offset_[i] - now);
    offset_[i] = now;
  }
}

// Where the zero moves under G68, the centre may go with it or stay: no source says.
bool Machine::applyOffsets() {
  const Position before = offset_;
  updateOffsets();
  for (std::size_t i = 0; i < kAxes; ++i)
    if (rotation_.turns(i) && offset_[i] != before[i]) return refuseTurned("another zero of the work system");
  return true;
}

bool Machine::changeSystem(const NcWords& w) {
  if ((block_.slots >> kSystem & 1) == 0) return true;
  bool changed = modes_[kSystem] != block_.before[kSystem];
  if (modes_[kSystem] == kExtended) {
    const std::optional<std::uint32_t> number = w.has('P') ? whole(w, 'P') : std::optional<std::uint32_t>(1);
    if (!number || *number == 0 || *number >= extended_.size())
      return inconclusive(fmt::format("additional systems are P1 to P{}", extended_.size() - 1),
                          w.has('P') ? 'P' : 'G');
    changed = changed || *number != extendedNow_;
    extendedNow_ = *number;
  }
  if (changed && rotation_.on()) return refuseTurned("another work system");
  updateOffsets();
  if (trace_ != nullptr && changed) {
    trace_->begin("system").text(modes_[kSystem] == kExtended ? fmt::format("54.1 P{}", extendedNow_)
                                                              : std::to_string(54 + modes_[kSystem]));
    trace_->position(knownPosition(), shown_).end();
  }
  return true;
}

bool Machine::changeToolLength(const NcWords& w) {
  const bool code = (block_.slots >> kLength & 1) != 0;
  if (!code && !(w.has('H') && modes_[kLength] != 0)) return true;
  double length = 0;
  const std::optional<std::uint32_t> number = w.has('H') ? whole(w, 'H') : std::optional<std::uint32_t>(0);
  if (modes_[kLength] != 0) {
    if (modes_[kPlane] != 0 && code)
      return inconclusive("which axis the tool length is added to depends on a parameter", 'G');
    const double h = modalWords_[slotOf('H')];
    if (!number || !(h >= 0) || (h != 0 && h >= static_cast<double>(tools_.size())))
      return inconclusive(fmt::format("`{}` has tool offsets up to {}", control_->name, tools_.size() - 1),
                          w.has('H') ? 'H' : 'G');
    const ToolOffset& tool = tools_[static_cast<std::size_t>(h)];
    if (watcher_ != nullptr && h != 0 && tool.wear == 0 && tool.geometry == 0)
      watcher_->lengthNotSet(static_cast<std::uint32_t>(h));
    length = (modes_[kLength] == 1 ? 1 : -1) * snap(tool.wear + tool.geometry);
  }
  const bool changed = length != toolLength_ || modes_[kLength] != block_.before[kLength];
  // Whether the machine or its coordinates move by the difference depends on a parameter; the next absolute Z
  // settles it.
  if (lengthKeepsPlace_)
    work_[2] = snap(work_[2] + toolLength_ - length);
  else if (length != toolLength_)
    lose(1u << 2, modes_[kLength] != 0 ? "G43" : "G49");
  toolLength_ = length;
  lengthInDoubt_ = false;
  if (trace_ != nullptr && changed) {
    static constexpr std::string_view kNames[] = {"off", "+", "-"};
    trace_->begin("tool-length").text(kNames[modes_[kLength]]);
    if (modes_[kLength] != 0) trace_->text(fmt::format("H{:.0f}", modalWords_[slotOf('H')]));
    trace_->end();
  }
  return true;
}

bool Machine::dwell(const NcWords& w) {
  const char own = dialect_.dwellLetter;
  const bool hasOwn = own != 0 && w.has(own);
  const int given = (w.has('P') ? 1 : 0) + (w.has('X') ? 1 : 0) + (w.has('U') ? 1 : 0) + (hasOwn ? 1 : 0);
  if (given > 1 || (w.present & kAxisBits & ~ir::addressBits("XU")) != 0)
    return inconclusive("a dwell takes one of P, X and U", 'G');
  double seconds = 0;
  const bool byP = own == 0 && control_->dwellLetter == 'P';
  if (byP && given == 1 && !w.has('P'))
    return inconclusive("a dwell takes P on this control; no source documents another address", 'G');
  if (byP && w.has('P') && (w.pointed & ir::addressBit('P')) != 0) {
    seconds = w.of('P');
    if (!(seconds >= 0)) return inconclusive("a dwell is not below 0", 'P');
  } else if (w.has('P')) {
    const std::optional<std::uint32_t> milliseconds = whole(w, 'P');
    if (!milliseconds) return inconclusive("a dwell counts whole milliseconds here", 'P');
    seconds = *milliseconds / 1000.0;
  } else if (given == 1) {
    const char letter = hasOwn ? own : w.has('X') ? 'X' : 'U';
    const bool bare = (needPoint_ & ~w.pointed & ir::addressBit(letter)) != 0;
    seconds = bare ? w.of(letter) / 1000.0 : w.of(letter);
    if (!(seconds >= 0)) return inconclusive("a dwell is not below 0", letter);
  }
  seconds_ += seconds;
  if (watcher_ != nullptr) watcher_->dwelled(seconds);
  if (trace_ != nullptr) trace_->begin("dwell").word("", seconds).end();
  return true;
}

// G10 L2, L20: work offsets; L1, L10 to L13: tool offsets. Others are not known.
bool Machine::dataInput(const NcWords& w) {
  if (turning_ != nullptr && (!w.has('L') || (w.present & ir::addressBits("UVWH")) != 0))
    return inconclusive(
        "what it changes of the offsets of turning tools is not followed; G10 L2 is, with axes by "
        "their own letters",
        'G');
  if (!w.has('L') || !w.has('P')) return inconclusive("G10 is known with L and P", w.has('L') ? 'L' : 'G');
  const std::optional<std::uint32_t> kind = whole(w, 'L'), number = whole(w, 'P');
  const bool add = modes_[kDistance] != 0;
  if (!number) return inconclusive("it is no number of an offset", 'P');
  if (kind == 2u || kind == 20u) {
    const std::size_t last = kind == 2u ? systems_.size() : extended_.size() - 1;
    if (*number > last || (kind == 20u && *number == 0))
      return inconclusive(fmt::format("P goes to {}", last), 'P');
    if (w.has('R')) return inconclusive("nothing in the block takes it", 'R');
    Position& offset = kind == 20u ? extended_[*number] : *number == 0 ? external_ : systems_[*number - 1];
    for (std::size_t i = 0; i < kAxes; ++i) {
      if (!has(w, i)) continue;
      const double value = lengthOf(w, kAxisLetters[i]), before = offset[i];
      offset[i] = add ? snap(offset[i] + value) : value;
      if (watcher_ == nullptr) continue;
      const std::string name = kind == 20u    ? fmt::format("G54.1 P{}", *number)
                               : *number == 0 ? std::string("external")
                                              : fmt::format("G{}", 53 + *number);
      watcher_->offsetWritten({fmt::format("{} {}", name, kAxisLetters[i]), before, offset[i]});
    }
    if (!applyOffsets()) return false;
    if (trace_ != nullptr) {
      trace_->begin("offset").text(fmt::format("L{} P{}", *kind, *number)).position(offset, shown_).end();
    }
    return true;
  }
  if (kind && (*kind == 1 || (*kind >= 10 && *kind <= 13))) {
    if (*number == 0 || *number >= tools_.size())
      return inconclusive(fmt::format("`{}` has tool offsets up to {}", control_->name, tools_.size() - 1),
                          'P');
    if (!w.has('R') || (w.present & kAxisBits) != 0) return inconclusive("a tool offset takes R", 'G');
    if (*kind >= 12) return setRadius(*number, *kind == 13, lengthOf(w, 'R'), add);
    double& value = *kind == 10 ? tools_[*number].geometry : tools_[*number].wear;
    const double before = value;
    value = snap((add ? value : 0) + lengthOf(w, 'R'));
    if (watcher_ != nullptr)
      watcher_->offsetWritten(
          {fmt::format("tool {} {}", *number, *kind == 10 ? "geometry" : "wear"), before, value, *number});
    if (trace_ != nullptr)
      trace_->begin("tool-offset").text(fmt::format("L{} P{}", *kind, *number)).word("", value).end();
    return true;
  }
  return inconclusive("what it sets is not known to Dotek", 'L');
}

// L12: geometry; L13: wear.
bool Machine::setRadius(std::uint32_t tool, bool wear, double value, bool add) {
  const stdlib::RadiusOffsets radii = stdlib::radiusOffsets(*control_);
  const std::optional<int> first = wear ? radii.wear : radii.geometry;
  Place place;
  if (!first || !find(static_cast<std::uint32_t>(*first) + tool, place) || place.kind != Place::Kind::State)
    return inconclusive(
        fmt::format("the profile of `{}` names no variables with offsets of a tool's radius", control_->name),
        'L');
  double& offset = state_[place.index];
  const double before = offset;
  offset = snap((add ? offset : 0) + value);
  if (watcher_ != nullptr)
    watcher_->offsetWritten(
        {fmt::format("tool {} radius {}", tool, wear ? "wear" : "geometry"), before, offset});
  if (trace_ != nullptr)
    trace_->begin("tool-offset").text(fmt::format("L{} P{}", wear ? 13 : 12, tool)).word("", offset).end();
  return true;
}

bool Machine::localShift(const NcWords& w) {
  if (rotation_.on()) return refuseTurned("a local system");
  if (modes_[kDistance] != 0 || block_.increments != 0)
    return inconclusive("a local system in incremental mode is not known", 'G');
  for (std::size_t i = 0; i < kAxes; ++i)
    if (has(w, i)) local_[i] = lengthOf(w, kAxisLetters[i]);
  updateOffsets();
  if (trace_ != nullptr) trace_->begin("local").position(local_, shown_).end();
  return true;
}

bool Machine::limitsSpindle(const NcWords& w) const {
  return w.has('S') && block_.hasOneShot && block_.oneShot == Function::SetPosition;
}

// G92, and G92 S: the highest speed of the spindle under constant surface speed, which sets no coordinate.
bool Machine::setPosition(const NcWords& w) {
  if (w.has('S')) {
    if ((w.present & kAxisBits) != 0)
      return inconclusive("a limit of the spindle's speed and coordinates in one block; write two blocks",
                          'S');
    if (trace_ != nullptr) trace_->begin("spindle-limit").word("S", w.of('S')).end();
    return true;
  }
  if (block_.increments != 0)
    return inconclusive(
        "a shift of the coordinates by increments; write the coordinates that the place shall have", 'G');
  if (rotation_.on()) return refuseTurned("G92");
  const Position& system = systemOffset();
  for (std::size_t i = 0; i < kAxes; ++i) {
    if (!has(w, i)) continue;
    if ((uncertain_ >> i & 1) != 0)
      return inconclusive("the position of this axis is not known", kAxisLetters[i]);
    const double value = lengthOf(w, kAxisLetters[i]);
    const double sum = snap(work_[i] + offset_[i] - value); // so that the machine is still
    local_[i] = 0;
    shift_[i] = snap(sum - external_[i] - system[i]);
    offset_[i] = sum;
    work_[i] = value;
  }
  if (watcher_ != nullptr) watcher_->positionSet();
  if (trace_ != nullptr) trace_->begin("set-position").position(knownPosition(), shown_).end();
  return running();
}

} // namespace dotek::sim
