// What a call leaves: tolerances that stop, offsets, results.
#include "sim/machine/Measurement.h"
#include "stdlib/KeptResults.h"
#include "tests/oracle/VendorRun.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace dotek::oracle {

using namespace dotek::sim;

using stdlib::Intent;
using stdlib::MacroAlarm;
using stdlib::SystemCode;

namespace {

constexpr double kNothing = 1e-9; // no difference of lengths on a grid of a nanometre
constexpr double kNoContact = 2;  // #149 of a touch that was told to raise no alarm
constexpr double kQuarter = 90;   // degrees
constexpr std::uint32_t kFirstSystem = 54, kSystems = 6;

std::string fixed(double value) {
  std::string out;
  appendFixed6(out, value);
  return out;
}

// A number that chooses something; nothing: it is none.
std::optional<std::uint32_t> whole(double value) {
  if (!(value >= 0 && value < 1e6) || value != std::floor(value)) return std::nullopt;
  return static_cast<std::uint32_t>(value);
}

// The number that a call gives for G54.
std::uint32_t firstNumber(const stdlib::MacroArgument& chosen) {
  return chosen.systemCode == SystemCode::GNumber ? kFirstSystem : 1;
}

} // namespace

bool VendorRun::finish() {
  if (signature_.intent != Intent::ProtectedMove) {
    if (!machine_.travelTo(start_) || !addExperience()) return false;
    if (size_) {
      found_[Output::Size] = *size_;
      found_[Output::SizeError] = *size_ - *expectedSize_;
    }
    found_[Output::OutOfTolerance] = 0;
    found_[Output::ProbeError] = missed_ ? kNoContact : 0;
    if (MotionWatcher* const watcher = machine_.watcher(); watcher != nullptr && !missed_)
      watcher->measured(foundHere());
  }
  if (!checkTolerances()) return false;
  writeResults();
  if (!setSystem() || !setTool()) return false;
  if (const auto print = value(Role::Print)) machine_.remark("print", fmt::format("{:g}", *print));
  machine_.forgetMotion(feed_);
  return true;
}

// What the call says of a coordinate counts in the system that it sets, what was measured in the active one.
Measurement VendorRun::foundHere() const {
  Measurement out = measurementOf(signature_, locals_, found_);
  const auto set = argument(Role::System) == nullptr ? std::nullopt : systemGiven();
  if (!set || *set == machine_.activeSystem()) return out;
  for (const ir::Axis axis : ir::kAxes) {
    if (argument(Role::Nominal, axis) == nullptr) continue;
    for (MeasuredValue& one : out.values)
      if (one.name == std::string_view(&kAxisLetters[ir::indexOf(axis)], 1)) one.nominal.reset();
  }
  return out;
}

// The value of a tool offset is added to the measured size.
bool VendorRun::addExperience() {
  const auto given = value(Role::Experience);
  if (!given) return true;
  const auto& v = control_.variables;
  const auto number = whole(*given);
  if (!size_)
    return notKnown("what an experience value does without a size is in no source",
                    argument(Role::Experience)->letter);
  if (!number || *number == 0 || static_cast<int>(*number) > v.toolCount || !v.toolWear)
    return meaningless("it is no tool offset of the control", argument(Role::Experience)->letter);
  double sum = 0;
  bool both = true;
  for (const auto& first : {v.toolWear, v.toolGeometry}) {
    if (!first) continue;
    const auto part = machine_.read(static_cast<std::uint32_t>(*first) + *number);
    if (!part) return false;
    both = both && *part != 0;
    sum += *part;
  }
  if (v.toolGeometry && sum != 0)
    return notKnown("whether the wear or the geometry holds the experience value is in no source",
                    argument(Role::Experience)->letter);
  *size_ += sum;
  return true;
}

bool VendorRun::checkTolerances() {
  double largest = 0, square = 0;
  for (const auto& error : error_) {
    if (!error) continue;
    largest = std::max(largest, std::abs(*error));
    square += *error * *error;
  }
  const double off = std::sqrt(square);
  const double size = size_ ? std::abs(*size_ - *expectedSize_) : off;
  const auto beyond = [&](Role role, double error) {
    const auto limit = value(role);
    return limit && error > std::abs(*limit) + kNothing;
  };
  if (beyond(Role::UpperLimit, std::max(largest, size))) return alarm(MacroAlarm::UpperLimit);
  if (beyond(Role::SizeTolerance, size)) return alarm(MacroAlarm::OutOfTolerance);
  if (beyond(Role::PositionTolerance, 2 * off)) return alarm(MacroAlarm::OutOfPosition);
  if (angleError_ && beyond(Role::AngleTolerance, std::abs(*angleError_)))
    return alarm(MacroAlarm::OutOfAngle);
  if (!angleError_ && argument(Role::AngleTolerance) != nullptr)
    return notKnown("which angle it compares without a second touch of each face is in no source",
                    argument(Role::AngleTolerance)->letter);
  return true;
}

// The variable of a work offset: `system` from 0, of G54.1 from 1.
std::optional<std::uint32_t> VendorRun::offsetVariable(std::uint32_t system, bool extended,
                                                       ir::Axis axis) const {
  const auto& v = control_.variables;
  const int step = static_cast<int>(ir::indexOf(axis)) * v.axisStep;
  if (extended) {
    if (!v.extendedX || system == 0 || static_cast<int>(system) > v.extendedCount) return std::nullopt;
    return static_cast<std::uint32_t>(*v.extendedX + (static_cast<int>(system) - 1) * v.extendedStep + step);
  }
  if (!v.workOffsetX || system >= kSystems) return std::nullopt;
  return static_cast<std::uint32_t>(*v.workOffsetX + static_cast<int>(system) * v.systemStep + step);
}

std::optional<Machine::WorkSystem> VendorRun::systemGiven() const {
  const stdlib::MacroArgument& chosen = *argument(Role::System);
  if (const std::uint32_t n = stdlib::extendedSystem(chosen, *value(Role::System)); n != 0)
    return Machine::WorkSystem{n, true};
  const auto number = whole(*value(Role::System));
  if (!number) return std::nullopt;
  const std::uint32_t first = firstNumber(chosen);
  if (*number < first || *number >= first + kSystems) return std::nullopt;
  return Machine::WorkSystem{*number - first, false};
}

// New value = offset in force + measured - expected: right for both rules, since only what is expected
// differs.
bool VendorRun::setSystem() {
  const auto* chosen = argument(Role::System);
  if (chosen == nullptr) return true;
  const auto given = systemGiven();
  if (!given) {
    const std::uint32_t first = firstNumber(*chosen);
    return meaningless(
        fmt::format("which work offset this number names is in no source; {} to {} are G54 to G59", first,
                    first + kSystems - 1),
        chosen->letter);
  }
  const auto [system, extended] = *given;
  const auto [active, activeExtended] = machine_.activeSystem();
  for (const ir::Axis axis : ir::kAxes) {
    const auto& error = error_[ir::indexOf(axis)];
    if (!error) continue;
    const auto from = offsetVariable(active, activeExtended, axis);
    const auto to = offsetVariable(system, extended, axis);
    if (!from || !to) return meaningless("the control has no such work offset", chosen->letter);
    const auto before = machine_.read(*from);
    if (!before || !machine_.writeMeasured(*to, *before + *error)) return false;
    const auto after = machine_.read(*to);
    if (!after) return false;
    if (machine_.trace() == nullptr) continue;
    const std::string name =
        extended ? fmt::format("54.1 P{}", system) : std::to_string(kFirstSystem + system);
    machine_.remark("offset", fmt::format("{} {}{}", name, ir::letterOf(axis), fixed(*after)));
  }
  return true;
}

// A surface that lies too high by the error: the tool that cut it counts as shorter by as much, so that it
// cuts lower next time.
bool VendorRun::setTool() {
  const auto* chosen = argument(Role::Tool);
  if (chosen == nullptr) return true;
  const auto number = whole(*value(Role::Tool));
  if (!number || *number == 0 || static_cast<int>(*number) > control_.variables.toolCount)
    return meaningless("it is no tool offset of the control", chosen->letter);
  const auto& error = error_[ir::indexOf(ir::Axis::Z)];
  if (!error || size_) return passes("Dotek keeps no offsets of the tool's radius", chosen->letter);
  if (const auto band = value(Role::NullBand); band && std::abs(*error) < *band) return true;
  const auto share = value(Role::Feedback);
  if (!share)
    return passes("which share of the error corrects the tool without F is in no source", chosen->letter);
  if (!(*share >= 0 && *share <= 1))
    return meaningless("a feedback goes from 0 to 1", argument(Role::Feedback)->letter);
  const auto& v = control_.variables;
  using Register = stdlib::ProbingFacts::ToolRegister;
  if (set_.probing.toolLength == Register::Unknown)
    return passes("whether it corrects the wear or the geometry is in no source", chosen->letter);
  const bool geometry = set_.probing.toolLength == Register::Geometry && v.toolGeometry;
  const auto& firstOffset = geometry ? v.toolGeometry : v.toolWear;
  if (!firstOffset) return meaningless("it is no tool offset of the control", chosen->letter);
  const std::uint32_t variable = static_cast<std::uint32_t>(*firstOffset) + *number;
  const auto before = machine_.read(variable);
  if (!before || !machine_.writeMeasured(variable, *before - *share * *error)) return false;
  machine_.remark("tool-offset", fmt::format("{} Z{}", *number, fixed(*before - *share * *error)));
  return true;
}

void VendorRun::leaveUnstated(std::uint32_t variable, std::optional<Output> meaning) {
  if (!memory_.passUnstated) return machine_.forget(variable);
  // The same where the control has the variables of the set elsewhere.
  std::uint64_t place = variable, block = 0;
  for (const auto& [first, last] : set_.overwritten) {
    ++block;
    if (variable >= first && variable <= last) place = block << 16U | (variable - first);
  }
  constexpr std::uint64_t kMix = 0x9E37'79B9'7F4A'7C15ULL;
  std::uint64_t mixed = (std::uint64_t{memory_.measured} << 32U | place) * kMix;
  // Another one with other values of the call, coarser than their last digits.
  std::uint64_t call = memory_.measured;
  const stdlib::MacroArgument* const system = argument(Role::System);
  const std::size_t ofSystem = system == nullptr ? 0 : stdlib::localOf(system->letter);
  for (std::size_t i = 0; i < locals_.size(); ++i) {
    double local = locals_[i];
    if (isNull(local) || isUnknown(local) || std::abs(local) >= 1e6) continue;
    // Systems beyond G59 are the same ones by whatever number a control has for them.
    if (i != 0 && i == ofSystem)
      if (const std::uint32_t n = stdlib::extendedSystem(*system, local); n != 0) local = 1000 + n;
    for (std::uint64_t* one : {&mixed, &call})
      *one = (*one ^ static_cast<std::uint64_t>(std::llround(local * 8))) * kMix;
  }
  mixed ^= mixed >> 29U;
  // Programs ask for 0 as for nothing found wrong.
  const bool none = (mixed >> 40U) % 3 == 0;
  // The two faces of a corner are near an axis each.
  const bool turned = (call >> 40U) % 2 == 1;
  const bool along = (meaning == Output::Angle && turned) || (meaning == Output::AngleY && !turned);
  const double near = along ? kQuarter : 0;
  machine_.writeMeasured(variable, near + (none ? 0 : (static_cast<double>(mixed % 2001) - 1000) / 1000));
}

void VendorRun::writeResults() {
  const bool measures = signature_.intent != Intent::ProtectedMove && signature_.intent != Intent::ProbeOn &&
                        signature_.intent != Intent::ProbeOff;
  const bool keeps = stdlib::keepsResults(signature_);
  if (keeps && memory_.results.empty()) memory_.results = stdlib::measuredVariables(set_);
  const auto isResult = [&](std::uint32_t variable) {
    return variable < memory_.results.size() && memory_.results[variable];
  };
  if (measures) ++memory_.measured;
  for (const auto& [first, last] : set_.overwritten)
    for (std::uint32_t variable = first; (measures || !memory_.passUnstated) && variable <= last; ++variable)
      if (variable != set_.probing.feedVariable && !(keeps && isResult(variable))) leaveUnstated(variable);
  if (feed_ && set_.probing.feedVariable) machine_.write(*set_.probing.feedVariable, *feed_);
  for (const stdlib::MacroResult& result : signature_.results) {
    const auto holds = result.documented ? std::optional<Output>(result.output) : result.taken;
    const auto found = holds ? found_.find(*holds) : found_.end();
    if (found == found_.end()) {
      leaveUnstated(result.variable, result.documented ? std::optional(result.output) : std::nullopt);
      continue;
    }
    if (!result.documented)
      sayOnce("assumed", fmt::format("#{} {}", result.variable, stdlib::outputName(*holds)));
    machine_.writeMeasured(result.variable, found->second);
  }
}

} // namespace dotek::oracle
