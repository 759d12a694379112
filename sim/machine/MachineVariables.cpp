// Variables of macros by number: locals, commons, and the system variables that the control's table places.
#include "sim/machine/Axes.h"
#include "sim/machine/Measurement.h"
#include "sim/machine/Place.h"
#include "sim/machine/SystemWatcher.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace dotek::sim {

using stdlib::Alarm;

bool Machine::find(std::uint32_t number, Place& place) const {
  using Kind = Place::Kind;
  const stdlib::SystemVariables& v = control_->variables;
  const auto n = static_cast<long>(number);
  const auto numbered = [&](std::size_t at) -> std::optional<std::size_t> {
    if (turning_ == nullptr) return at;
    if (at >= turning_->axes.size()) return std::nullopt;
    return std::string_view(kAxisLetters).find(turning_->axes[at]);
  };
  const auto axisOf = [&](std::optional<int> first, Kind kind) {
    if (!first || n < *first || n >= *first + static_cast<long>(kAxes)) return false;
    const auto axis = numbered(static_cast<std::size_t>(n - *first));
    if (axis) place = {kind, 0, *axis};
    return axis.has_value();
  };
  // Offsets are in steps of systems and of axes, the smaller one within the larger.
  const auto offset = [&](std::optional<int> first, int step, int count, Kind kind) {
    if (!first || n < *first) return false;
    const long at = n - *first;
    const long axisStep = v.axisStep;
    const long system = step > axisStep || count == 1 ? (count == 1 ? 0 : at / step) : at % axisStep / step;
    const long rest = at - system * step;
    if (axisStep == 0 || rest < 0 || rest % axisStep != 0) return false;
    const long axis = rest / axisStep;
    if (system >= count || axis >= static_cast<long>(kAxes)) return false;
    const auto own = numbered(static_cast<std::size_t>(axis));
    if (own) place = {kind, static_cast<std::size_t>(system), *own};
    return own.has_value();
  };
  const auto tool = [&](std::optional<int> first, Kind kind) {
    if (!first || n < *first || n > *first + v.toolCount) return false;
    place = {kind, static_cast<std::size_t>(n - *first), 0};
    return true;
  };
  const auto one = [&](std::optional<int> first, Kind kind) {
    if (!first || n != *first) return false;
    place = {kind, 0, 0};
    return true;
  };
  if (one(v.alarm, Kind::Write) || one(v.message, Kind::Write) || one(v.timer, Kind::Timer) ||
      one(v.hours, Kind::Hours) || one(v.extendedNumber, Kind::ExtendedNumber) || findState(number, place))
    return true;
  if (v.modalFirst && n > *v.modalFirst && n < *v.modalFirst + kGroups) {
    place = {Kind::Modal, static_cast<std::size_t>(n - *v.modalFirst), 0};
    return true;
  }
  if (v.modalFeed && n == *v.modalFeed) {
    place = {Kind::Word, slotOf('F'), 0};
    return true;
  }
  if (v.modalWords) {
    for (const auto& [at, letter] :
         {std::pair(2, 'B'), std::pair(7, 'D'), std::pair(11, 'H'), std::pair(13, 'M'), std::pair(14, 'N'),
          std::pair(15, 'O'), std::pair(19, 'S'), std::pair(20, 'T')}) {
      if (n != *v.modalWords + at) continue;
      place = {Kind::Word, slotOf(letter), 0};
      return true;
    }
  }
  return axisOf(v.blockEnd, Kind::BlockEnd) || axisOf(v.machine, Kind::MachinePosition) ||
         axisOf(v.position, Kind::Now) || axisOf(v.skip, Kind::Skip) ||
         axisOf(v.toolLength, Kind::ToolLength) || offset(v.externalX, 0, 1, Kind::External) ||
         offset(v.workOffsetX, v.systemStep, 6, Kind::System) ||
         offset(v.extendedX, v.extendedStep, v.extendedCount, Kind::Extended) ||
         tool(v.toolWear, Kind::Wear) || tool(v.toolGeometry, Kind::Geometry) ||
         tool(v.toolWearToo, Kind::Wear) || tool(v.toolGeometryToo, Kind::Geometry);
}

std::optional<double> Machine::read(std::uint32_t number) {
  if (number == 0) return kNull;
  if (const std::uint32_t cell = layout_.cellOf(number); cell != CellLayout::kNone) {
    if (!isUnknown(cells_[cell])) return isNull(cells_[cell]) ? kNull : cells_[cell];
    inconclusive(fmt::format("#{} is read, and what a macro left there is not known", number));
    return std::nullopt;
  }
  Place place;
  if (number >= 1000 && find(number, place)) {
    const std::optional<double> value = readSystem(number, place);
    return value && !isNull(*value) ? *value / unitOf(place) : value;
  }
  if (number < 1000 || number == UINT32_MAX) {
    raise(Alarm::NoSuchVariable);
  } else if (control_->isToolOffset(number)) {
    if (const auto given = givenOffsets_.find(number); given != givenOffsets_.end()) return given->second;
    inconclusive(fmt::format("what #{0} holds depends on the control's memory for offsets; `--var {0}=VALUE` "
                             "gives it a value, which has no effect on a move",
                             number));
  } else {
    inconclusive(fmt::format("what #{} holds is not known to Dotek", number));
  }
  return std::nullopt;
}

bool Machine::changesWithMotion(std::uint32_t number) const {
  using Kind = Place::Kind;
  Place place;
  return number >= 1000 && find(number, place) &&
         (place.kind == Kind::MachinePosition || place.kind == Kind::Now || place.kind == Kind::Skip ||
          place.kind == Kind::Window);
}

bool Machine::isSkipPosition(std::uint32_t number) const {
  Place place;
  return number >= 1000 && find(number, place) && place.kind == Place::Kind::Skip;
}

bool Machine::movesPositions(std::uint32_t number) const {
  using Kind = Place::Kind;
  Place place;
  return number >= 1000 && find(number, place) &&
         (place.kind == Kind::External || place.kind == Kind::System || place.kind == Kind::Extended ||
          place.kind == Kind::Wear || place.kind == Kind::Geometry);
}

// Under G20 lengths and the feed are those of the input: B-63944EN, 8.2, says it of work offsets and tool
// offsets; positions are taken to be no other.
bool Machine::inInches(const Place& place) const {
  using Kind = Place::Kind;
  if (modes_[kUnits] == 0) return false;
  switch (place.kind) {
  case Kind::BlockEnd:
  case Kind::MachinePosition:
  case Kind::Now:
  case Kind::Skip:
  case Kind::External:
  case Kind::System:
  case Kind::Extended: return place.axis < 3;
  case Kind::ToolLength:
  case Kind::Wear:
  case Kind::Geometry: return true;
  case Kind::State: return radiusIn(place).has_value();
  case Kind::Word: return place.index == slotOf('F');
  case Kind::Modal:
  case Kind::Timer:
  case Kind::Hours:
  case Kind::ExtendedNumber:
  case Kind::StateWord:
  case Kind::WindowAddress:
  case Kind::Window:
  case Kind::Write:
  case Kind::None: break;
  }
  return false;
}

double Machine::unitOf(const Place& place) const {
  using Kind = Place::Kind;
  const bool ofX = place.axis == 0 && countsDiameters() &&
                   (place.kind == Kind::BlockEnd || place.kind == Kind::MachinePosition ||
                    place.kind == Kind::Now || place.kind == Kind::Skip || place.kind == Kind::External ||
                    place.kind == Kind::System || place.kind == Kind::Extended);
  return (inInches(place) ? kInch : 1.0) / (ofX ? 2 : 1);
}

std::optional<double> Machine::readSystem(std::uint32_t number, const Place& place) {
  using Kind = Place::Kind;
  const auto position = [&](const Position& of, bool exact) -> std::optional<double> {
    // Under cutter compensation the tool's centre does not appear where the program says.
    if ((uncertain_ >> place.axis & 1) != 0 || (exact && (modes_[kComp] != 0 || offsets_.active()))) {
      inconclusive(fmt::format(
          "#{} is read while the position of {} is not known{}", number, kAxisLetters[place.axis],
          (uncertain_ >> place.axis & 1) != 0
              ? lostText(1u << place.axis)
              : ": cutter compensation is on, and the tool's centre is not where the program says"));
      return std::nullopt;
    }
    return of[place.axis];
  };
  if (watcher_ != nullptr && (place.kind == Kind::Skip || place.kind == Kind::BlockEnd ||
                              place.kind == Kind::Now || place.kind == Kind::MachinePosition))
    watcher_->positionRead(place.kind == Kind::Skip);
  switch (place.kind) {
  case Kind::Modal: {
    const std::uint32_t tenths = groups_[place.index];
    if (motionForgotten_ && place.index == table_.g(10).group && !motionKnown()) return std::nullopt;
    const Code& code = table_.g(tenths);
    if (tenths == 0 && (code.flags & Code::Unknown) == 0 && code.group == place.index) return 0.0; // G0
    if (tenths == 0) {
      inconclusive(fmt::format("what #{} holds at the start is not known", number));
      return std::nullopt;
    }
    return tenths / 10.0;
  }
  case Kind::Word:
    if (place.index == slotOf('F') && !feedKnown()) return std::nullopt;
    return place.index == slotOf('F') ? feed_ : modalWords_[place.index];
  case Kind::BlockEnd:
    if (!position(work_, false)) return std::nullopt;
    return turnedVariable(number, place.axis, work_, rotation_.turnedBack(work_));
  case Kind::MachinePosition: {
    std::optional<double> out = position(machinePosition(), true);
    if (out && work_ == skipped_) out = snap(*out + beyond_[place.axis]);
    return out;
  }
  case Kind::Now:
  case Kind::Skip: {
    const bool skip = place.kind == Kind::Skip;
    if (skip && lastSkip_ == Skip::None) {
      inconclusive(fmt::format("#{} is read before any skip move of this run: it holds where an earlier run "
                               "was stopped by the signal; move by G31 first",
                               number));
      return std::nullopt;
    }
    if (!skip && !position(work_, true)) return std::nullopt;
    std::optional<double> out = skip ? turnedVariable(number, place.axis, skipped_, skippedTurned_)
                                     : turnedVariable(number, place.axis, work_, rotation_.turnedBack(work_));
    if (out && !skip && work_ == skipped_) out = snap(*out + beyond_[place.axis]);
    if (out && place.axis == 2 && toolLength_ != 0) {
      const std::optional<stdlib::LengthInPositions>& with = control_->withToolLength;
      if (!with) {
        inconclusive(fmt::format("whether #{} holds the length of the tool is not known of {}", number,
                                 control_->title));
        return std::nullopt;
      }
      if (skip ? with->skip : with->position) out = snap(*out + toolLength_);
    }
    return out;
  }
  case Kind::ToolLength: return place.axis == 2 ? toolLength_ : 0.0;
  case Kind::External: return external_[place.axis];
  case Kind::System: return systems_[place.index][place.axis];
  case Kind::Extended: return extended_[place.index + 1][place.axis];
  case Kind::Wear: return tools_[place.index].wear;
  case Kind::Geometry: return tools_[place.index].geometry;
  case Kind::Timer: return std::floor((seconds_ - timerBase_) * 1000 + 1e-6);
  case Kind::Hours: return (seconds_ - hoursBase_) / 3600;
  case Kind::ExtendedNumber:
    if (modes_[kSystem] == kExtended) return static_cast<double>(extendedNow_);
    inconclusive(fmt::format("#{} is read while no additional work system is in force", number));
    return std::nullopt;
  case Kind::State:
  case Kind::StateWord:
  case Kind::WindowAddress:
  case Kind::Window:
    if (auto* const outside = dynamic_cast<SystemWatcher*>(watcher_)) {
      if (const auto value = outside->systemRead(number)) return value;
    }
    return readState(number, place);
  case Kind::Write:
  case Kind::None: break;
  }
  inconclusive(fmt::format("what #{} holds is not known to Dotek", number));
  return std::nullopt;
}

bool Machine::write(std::uint32_t number, double value) {
  return store(number, value, false);
}

bool Machine::writeMeasured(std::uint32_t number, double value) {
  measured_.push_back(number);
  return store(number, value, false);
}

bool Machine::preset(std::uint32_t number, double value) {
  if (const std::uint32_t cell = layout_.cellOf(number); cell != CellLayout::kNone)
    presets_.emplace_back(cell, value);
  return store(number, value, true);
}

std::uint32_t Machine::addCells(std::uint32_t count) {
  const auto first = static_cast<std::uint32_t>(cells_.size());
  cells_.resize(cells_.size() + count, kNull);
  return first;
}

std::vector<std::pair<std::uint32_t, double>> Machine::written() const {
  std::vector<std::pair<std::uint32_t, double>> out;
  for (std::uint32_t cell = 1; cell < layout_.size(); ++cell) {
    const bool below = cell <= layout_.locals() && !saved_.empty(); // the main program's lie lowest
    const double value = below ? saved_[cell - 1] : cells_[cell];
    bool given = isFresh(value);
    for (const auto& [at, preset] : presets_)
      given = given || (at == cell && value == preset);
    if (!given) out.emplace_back(layout_.numberOf(cell), value);
  }
  std::sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  return out;
}

bool Machine::store(std::uint32_t number, double value, bool preset) {
  using Kind = Place::Kind;
  if (number == 0) return raise(Alarm::WriteProtected);
  if (const std::uint32_t cell = layout_.cellOf(number); cell != CellLayout::kNone) {
    cells_[cell] = isNull(value) ? kNull : value;
    return true;
  }
  if (number < 1000 || number == UINT32_MAX) return raise(Alarm::NoSuchVariable);
  Place place;
  if (!find(number, place)) {
    const bool offset = control_->isToolOffset(number);
    if (offset && (preset || givenOffsets_.contains(number))) {
      givenOffsets_[number] = isNull(value) ? 0 : value;
      return true;
    }
    return inconclusive(offset ? fmt::format("what #{0} sets depends on the control's memory for offsets; "
                                             "`--var {0}=VALUE` makes it a value without effect on a move",
                                             number)
                               : fmt::format("what #{} sets is not known to Dotek", number));
  }
  // A system variable holds numbers: null counts as 0 there.
  const double given = isNull(value) ? 0 : value;
  const double length = snap(given * unitOf(place));
  const auto set = [&](double& offset, const auto& name) {
    const bool ofTool = place.kind == Kind::Wear || place.kind == Kind::Geometry;
    if (watcher_ != nullptr && !preset)
      watcher_->offsetWritten({name(), offset, length, ofTool ? static_cast<std::uint32_t>(place.index) : 0});
    offset = length;
  };
  const auto axis = [&] { return kAxisLetters[place.axis]; }; // of the kinds that have one
  switch (place.kind) {
  case Kind::External: set(external_[place.axis], [&] { return fmt::format("external {}", axis()); }); break;
  case Kind::System:
    set(systems_[place.index][place.axis], [&] { return fmt::format("G{} {}", 54 + place.index, axis()); });
    break;
  case Kind::Extended:
    set(extended_[place.index + 1][place.axis],
        [&] { return fmt::format("G54.1 P{} {}", place.index + 1, axis()); });
    break;
  case Kind::Wear:
  case Kind::Geometry: {
    if (place.index == 0) return raise(Alarm::WriteProtected);
    const bool wear = place.kind == Kind::Wear;
    set(wear ? tools_[place.index].wear : tools_[place.index].geometry,
        [&] { return fmt::format("tool {} {}", place.index, wear ? "wear" : "geometry"); });
    return true;
  }
  case Kind::Timer: timerBase_ = seconds_ - given / 1000; return true;
  case Kind::Hours: hoursBase_ = seconds_ - given * 3600; return true;
  case Kind::State:
  case Kind::StateWord:
  case Kind::WindowAddress:
  case Kind::Window:
    if (const std::optional<bool> wear = place.kind == Kind::State ? radiusIn(place) : std::nullopt) {
      const std::uint32_t tool = number - control_->state[place.axis].first + 1;
      set(state_[place.index],
          [&] { return fmt::format("tool {} radius {}", tool, *wear ? "wear" : "geometry"); });
      return true;
    }
    if (!writeState(number, place, given, preset)) return false;
    if (auto* const outside = dynamic_cast<SystemWatcher*>(watcher_); outside != nullptr && !preset)
      outside->systemWritten(number, given);
    return true;
  case Kind::Write: return inconclusive(fmt::format("#{} needs a message", number));
  default: return raise(Alarm::WriteProtected);
  }
  return applyOffsets();
}

} // namespace dotek::sim
