// System variables that the machine only keeps, and the window into the memory of the PMC.
#include "sim/machine/Place.h"
#include "stdlib/RadiusOffsets.h"

#include <cmath>
#include <fmt/format.h>

namespace dotek::sim {

using stdlib::Alarm;
using stdlib::StateRange;

bool Machine::findState(std::uint32_t number, Place& place) const {
  using Kind = Place::Kind;
  std::size_t before = 0;
  for (std::size_t i = 0; i < control_->state.size(); ++i) {
    const StateRange& range = control_->state[i];
    if (number >= range.first && number <= range.last) {
      place = {Kind::State, before + (number - range.first), i};
      return true;
    }
    if (range.word && number == *range.word) {
      place = {Kind::StateWord, before, i};
      return true;
    }
    before += range.last - range.first + 1;
  }
  if (!control_->window) return false;
  const stdlib::PmcWindow& window = *control_->window;
  if (number == window.address)
    place = {Kind::WindowAddress, 0, 0};
  else if (number == window.byte)
    place = {Kind::Window, 1, 0};
  else if (number == window.word)
    place = {Kind::Window, 2, 0};
  else if (number == window.doubleWord)
    place = {Kind::Window, 4, 0};
  else
    return false;
  return true;
}

std::optional<bool> Machine::radiusIn(const Place& place) const {
  const std::string& title = control_->state[place.axis].title;
  if (title == stdlib::kRadiusWearTitle) return true;
  return title == stdlib::kRadiusGeometryTitle ? std::optional(false) : std::nullopt;
}

std::vector<double> Machine::snapshot() const {
  std::vector<double> out(cells_.begin(), cells_.begin() + layout_.size());
  const auto add = [&](const Position& position) { out.insert(out.end(), position.begin(), position.end()); };
  for (const Position* one : {&work_, &offset_, &external_, &local_, &shift_, &skipped_, &skippedTurned_})
    add(*one);
  for (const Position& one : systems_)
    add(one);
  for (const Position& one : extended_)
    add(one);
  for (const ToolOffset& tool : tools_)
    out.insert(out.end(), {tool.wear, tool.geometry});
  out.insert(out.end(), toolRadii_.begin(), toolRadii_.end());
  for (const auto& [number, value] : givenOffsets_)
    out.push_back(value);
  out.insert(out.end(), state_.begin(), state_.end());
  out.insert(out.end(), pmc_.begin(), pmc_.end());
  out.insert(out.end(), modes_.begin(), modes_.end());
  out.insert(out.end(), groups_.begin(), groups_.end());
  out.insert(out.end(), modalWords_.begin(), modalWords_.end());
  out.insert(out.end(),
             {feed_, speed_, static_cast<double>(spindle_), static_cast<double>(coolant_), toolLength_,
              static_cast<double>(toolNumber_), static_cast<double>(probe_), static_cast<double>(uncertain_),
              static_cast<double>(offsets_.active()), rotation_.degrees(), initialLevel_, cycleR_,
              cycleDepth_, seconds_, static_cast<double>(lastSkip_)});
  if (turning_ == nullptr) return out;
  add(cycleEnd_);
  out.insert(out.end(), {cycleTaper_, static_cast<double>(cycleAxes_)});
  for (const std::optional<double>& one : peckReturn_)
    out.push_back(one.value_or(-1));
  return out;
}

// How many bytes the variable spans; 0: they do not lie in the memory.
std::uint32_t Machine::windowBytes(const Place& place) const {
  const auto count = static_cast<std::uint32_t>(place.index);
  return pmcAddress_ >= 0 && pmcAddress_ + count <= static_cast<double>(pmc_.size()) ? count : 0;
}

std::optional<double> Machine::readState(std::uint32_t number, const Place& place) {
  using Kind = Place::Kind;
  const auto unknown = [&](std::string why) -> std::optional<double> {
    inconclusive(std::move(why));
    return std::nullopt;
  };
  switch (place.kind) {
  case Kind::State: {
    const double value = state_[place.index];
    if (isFresh(value))
      return unknown(fmt::format("what #{} holds ({}) is not known; `--var {}=VALUE` sets it", number,
                                 control_->state[place.axis].title, number));
    return value;
  }
  case Kind::StateWord: {
    const StateRange& range = control_->state[place.axis];
    double out = 0, weight = 1;
    for (std::uint32_t i = 0; i <= range.last - range.first; ++i, weight *= 2) {
      const double bit = state_[place.index + i];
      if (isFresh(bit))
        return unknown(fmt::format("what #{} holds ({}) is not known; `--var {}=VALUE` sets it", number,
                                   range.title, number));
      out += bit != 0 ? weight : 0;
    }
    return out;
  }
  case Kind::WindowAddress:
    if (pmcAddress_ < 0) return unknown(fmt::format("#{} is read before it is set", number));
    return pmcAddress_;
  default: break;
  }
  const std::uint32_t count = windowBytes(place);
  if (count == 0)
    return unknown(fmt::format("#{} is read at no address of the {} area that `{}` has", number,
                               control_->window->area, control_->name));
  std::uint32_t bits = 0; // the lowest byte is first
  for (std::uint32_t i = 0; i < count; ++i)
    bits |= static_cast<std::uint32_t>(pmc_[static_cast<std::size_t>(pmcAddress_) + i]) << (8 * i);
  // A byte counts from 0 to 255, words and double words have a sign.
  if (count == 2) return static_cast<double>(static_cast<std::int16_t>(bits));
  return count == 4 ? static_cast<double>(static_cast<std::int32_t>(bits)) : static_cast<double>(bits);
}

bool Machine::writeState(std::uint32_t number, const Place& place, double value, bool preset) {
  using Kind = Place::Kind;
  if (place.kind == Kind::State || place.kind == Kind::StateWord) {
    const StateRange& range = control_->state[place.axis];
    if (!preset && range.access == StateRange::Access::ReadOnly) return raise(Alarm::WriteProtected);
    if (range.null || (preset && range.access == StateRange::Access::ReadOnly && range.initial))
      return raise(Alarm::WriteProtected);
    if (!preset && range.access == StateRange::Access::Effect)
      return inconclusive(
          fmt::format("what follows when #{} is set ({}) is not known to Dotek", number, range.title));
    const std::uint32_t bits = range.last - range.first + 1;
    if (place.kind == Kind::State) {
      if (range.word && value != 0 && value != 1)
        return inconclusive(fmt::format("#{} is a signal; it is set to 0 or 1", number));
      state_[place.index] = value;
      if (modes_[kComp] != 0) long_ = 1; // it may be the radius in force
      return true;
    }
    if (!(value >= 0 && value < std::ldexp(1.0, static_cast<int>(bits))) || value != std::floor(value))
      return inconclusive(fmt::format("#{} holds {} signals; it is set to a whole number", number, bits));
    auto rest = static_cast<std::uint64_t>(value);
    for (std::uint32_t i = 0; i < bits; ++i, rest >>= 1)
      state_[place.index + i] = static_cast<double>(rest & 1);
    return true;
  }
  // A product such as 0.29 * 100 lies a little beside the whole number that is meant.
  const double whole = std::round(value);
  if (std::abs(value - whole) > 1e-6)
    return inconclusive(
        fmt::format("#{} takes whole numbers; what becomes of a fraction is not known", number));
  if (place.kind == Kind::WindowAddress) {
    if (!(whole >= 0 && whole < static_cast<double>(pmc_.size())))
      return inconclusive(fmt::format("`{}` has {} bytes of the {} area", control_->name, pmc_.size(),
                                      control_->window->area));
    pmcAddress_ = whole;
    return true;
  }
  const std::uint32_t count = windowBytes(place);
  if (count == 0)
    return inconclusive(fmt::format("#{} is written at no address of the {} area that `{}` has", number,
                                    control_->window->area, control_->name));
  const double range = std::ldexp(1.0, static_cast<int>(8 * count));
  if (!(whole >= -range / 2 && whole < range))
    return inconclusive(fmt::format("the value does not fit the {} bytes of #{}", count, number));
  const auto bits = static_cast<std::uint32_t>(static_cast<std::int64_t>(whole));
  for (std::uint32_t i = 0; i < count; ++i)
    pmc_[static_cast<std::size_t>(pmcAddress_) + i] = static_cast<std::uint8_t>(bits >> (8 * i));
  return true;
}

} // namespace dotek::sim
