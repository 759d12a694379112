#include "sim/device/Device.h"

#include "sim/machine/Arguments.h"
#include "sim/machine/Value.h"
#include "support/Decimal.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace dotek::sim {
namespace {

constexpr double kNow = 1e-9;
constexpr std::size_t kMostTouches = 100'000;

std::uint64_t mixed(std::uint64_t x) { // SplitMix64
  x += 0x9E3779B97F4A7C15u;
  x = (x ^ x >> 30) * 0xBF58476D1CE4E5B9u;
  x = (x ^ x >> 27) * 0x94D049BB133111EBu;
  return x ^ x >> 31;
}

// As a control reads it: a byte counts from 0 to 255, words and double words have a sign.
double numberOf(std::uint32_t bits, std::uint32_t bytes) {
  if (bytes == 2) return static_cast<std::int16_t>(bits);
  return bytes == 4 ? static_cast<double>(static_cast<std::int32_t>(bits)) : static_cast<double>(bits);
}

std::string withUnit(double value, const std::string& unit) {
  return unit.empty() ? numberText(value) : numberText(value) + " " + unit;
}

std::string seconds(double value) {
  return numberText(std::round(value * 1000) / 1000) + " s";
}

} // namespace

Device::Device(const DeviceFile& file, const stdlib::Control& control)
    : file_(file), window_(control.window), settles_(file.values.size(), 0), setBy_(file.values.size()),
      rows_(file.tables.size()), strobed_(file.tables.size(), false), sinceData_(file.tables.size(), 0) {
  for (std::size_t i = 0; i < file.values.size(); ++i)
    values_.push_back(limited(i, file.values[i].initial));
}

void Device::say(std::string what, std::string then, bool fault) {
  constexpr std::uint32_t kMostAlike = 3;
  if (report_ && ++said_[then] <= kMostAlike) report_(std::move(what), std::move(then), fault);
}

double Device::limited(std::size_t value, double wanted) const {
  const DeviceValue& of = file_.values[value];
  double out = of.perUnit > 0 ? std::round(wanted * of.perUnit) : wanted;
  if (of.range) out = std::clamp(out, of.range->first, of.range->second);
  return of.perUnit > 0 ? out / of.perUnit : out;
}

// ---- calls

bool Device::knows(std::uint32_t program) const {
  return std::any_of(file_.calls.begin(), file_.calls.end(),
                     [&](const DeviceCall& call) { return call.code.program == program; }) ||
         (next_ != nullptr && next_->knows(program));
}

bool Device::run(Machine& machine, std::uint32_t program, std::span<const double> locals) {
  for (const DeviceCall& call : file_.calls)
    if (call.code.program == program) return apply(call, locals, machine);
  return next_ != nullptr && next_->run(machine, program, locals);
}

bool Device::apply(const DeviceCall& call, std::span<const double> locals, Machine& machine) {
  const auto given = [&](std::uint32_t local) { return local < locals.size() ? locals[local] : kNull; };
  for (const auto& [local, value] : call.when)
    if (isNull(given(local)) || given(local) != value)
      return machine.inconclusive(fmt::format(
          "the device's file says what {} does where #{} of the call is {}, and here it is {}", call.name,
          local, numberText(value), isNull(given(local)) ? "not given" : numberText(given(local))));
  for (const auto& [local, value] : call.sets) {
    if (isNull(given(local)))
      return machine.inconclusive(
          fmt::format("{} without a value for `{}`; the device's file takes it from #{} "
                      "of the call",
                      call.name, file_.values[value].name, local));
    const double wanted = given(local), got = limited(value, wanted);
    const double half = file_.values[value].perUnit > 0 ? 0.5 / file_.values[value].perUnit : 0;
    if (std::abs(got - wanted) > half + 1e-9)
      say(fmt::format("{} asks for {}", call.name, withUnit(wanted, file_.values[value].unit)),
          fmt::format("the device applies {}, the end of its range",
                      withUnit(got, file_.values[value].unit)));
    values_[value] = got;
    settles_[value] = call.settle;
    setBy_[value] = call.name;
    machine.remark("device", fmt::format("{} {}", file_.values[value].name, numberText(got)));
  }
  return true;
}

// ---- memory

std::uint32_t Device::bytesAt(const DeviceCell& cell) const {
  std::uint32_t out = 0;
  for (std::uint32_t i = 0; i < cell.bytes; ++i) {
    const auto found = memory_.find(cell.address + i);
    if (found != memory_.end()) out |= static_cast<std::uint32_t>(found->second) << (8 * i);
  }
  return out;
}

double Device::cell(const DeviceCell& cell) const {
  double out = 0;
  if (cell.variable != 0) {
    const auto found = variables_.find(cell.variable);
    out = found == variables_.end() ? 0 : found->second;
  } else {
    out = numberOf(bytesAt(cell), cell.bytes);
  }
  if (!cell.bit) return out;
  return static_cast<double>(static_cast<std::uint64_t>(out) >> *cell.bit & 1);
}

// Whether the cell is touched by what was written.
bool Device::isOf(const DeviceCell& cell, std::uint32_t variable, std::uint32_t address,
                  std::uint32_t bytes) const {
  if (cell.variable != 0) return cell.variable == variable;
  return bytes != 0 && address < cell.address + cell.bytes && cell.address < address + bytes;
}

void Device::written(std::uint32_t variable, double value) {
  std::uint32_t address = 0, bytes = 0;
  if (window_ && variable == window_->address) {
    address_ = value;
    return;
  }
  if (window_ && variable != 0)
    bytes = variable == window_->byte         ? 1
            : variable == window_->word       ? 2
            : variable == window_->doubleWord ? 4
                                              : 0;
  if (bytes != 0) {
    if (address_ < 0) return;
    address = static_cast<std::uint32_t>(address_);
    const auto bits = static_cast<std::uint32_t>(static_cast<std::int64_t>(std::round(value)));
    for (std::uint32_t i = 0; i < bytes; ++i)
      memory_[address + i] = static_cast<std::uint8_t>(bits >> (8 * i));
  } else {
    variables_[variable] = value;
  }
  for (std::size_t i = 0; i < file_.tables.size(); ++i) {
    const DeviceTable& table = file_.tables[i];
    const bool data = isOf(table.index, variable, address, bytes) ||
                      std::any_of(table.columns.begin(), table.columns.end(), [&](const auto& column) {
                        return isOf(column.cell, variable, address, bytes);
                      });
    if (data && strobed_[i])
      say(fmt::format("the data of `{}` change while its strobe is on", table.name),
          "the device may take the old or the new ones");
    if (data) sinceData_[i] = 0;
    if (!isOf(table.strobe, variable, address, bytes)) continue;
    const bool on = cell(table.strobe) == table.strobeValue;
    if (on && strobed_[i])
      say(fmt::format("the strobe of `{}` is on already", table.name),
          "the device sees no new strobe and takes nothing over");
    else if (on)
      strobe(i);
    strobed_[i] = on;
  }
}

void Device::strobe(std::size_t at) {
  const DeviceTable& table = file_.tables[at];
  if (sinceData_[at] + kNow < table.hold)
    say(fmt::format("the data of `{}` are there for {} before its strobe, and the device needs {}",
                    table.name, seconds(sinceData_[at]), seconds(table.hold)),
        "the device may take what was there before");
  const double index = cell(table.index);
  if (!(index >= table.first && index <= table.last)) {
    say(fmt::format("the index of `{}` is {}, and its rows are {} to {}", table.name, numberText(index),
                    table.first, table.last),
        "the device takes nothing over");
    return;
  }
  std::vector<double> row;
  for (const DeviceTable::Column& column : table.columns)
    row.push_back(cell(column.cell) * column.scale);
  rows_[at][static_cast<std::uint32_t>(index)] = std::move(row);
}

std::optional<double> Device::read(std::uint32_t variable) {
  if (!window_ || address_ < 0) {
    for (const DeviceSignal& signal : file_.signals)
      if (signal.cell.variable == variable && variable != 0) return touching_ && touching_() ? 1 : 0;
    return std::nullopt;
  }
  const std::uint32_t bytes = variable == window_->byte         ? 1
                              : variable == window_->word       ? 2
                              : variable == window_->doubleWord ? 4
                                                                : 0;
  for (const DeviceSignal& signal : file_.signals) {
    const double on = touching_ && touching_() ? 1 : 0;
    if (signal.cell.variable != 0) {
      if (signal.cell.variable == variable) return on;
      continue;
    }
    const auto address = static_cast<std::uint32_t>(address_);
    if (bytes == 0 || signal.cell.address < address || signal.cell.address >= address + bytes) continue;
    DeviceCell place;
    place.address = address;
    place.bytes = bytes;
    const std::uint32_t bit = 8 * (signal.cell.address - address) + signal.cell.bit.value_or(0);
    std::uint32_t bits = bytesAt(place) & ~(1u << bit);
    if (on != 0) bits |= 1u << bit;
    return numberOf(bits, bytes);
  }
  return std::nullopt;
}

// ---- motion

void Device::dwelled(double time) {
  for (double& rest : settles_)
    rest = std::max(0.0, rest - time);
  for (double& since : sinceData_)
    since += time;
}

bool Device::moves(DeviceMoving moving, std::size_t axis) const {
  if (moving == DeviceMoving::Any || direction_[axis] == 0) return true;
  return (direction_[axis] > 0) == (moving == DeviceMoving::Plus);
}

std::optional<double> Device::ruled(const DeviceRule& rule, double position) const {
  const auto& rows = rows_[rule.table];
  if (rows.empty()) return std::nullopt;
  const double steps = (position - rule.from) / rule.step;
  const auto& [lowest, first] = *rows.begin();
  const std::uint32_t base = file_.tables[rule.table].first;
  if (steps <= lowest - static_cast<double>(base)) return limited(rule.value, first[rule.start]);
  // The last row at or before the position.
  auto row = rows.upper_bound(base + static_cast<std::uint32_t>(std::min(std::floor(steps + 1e-9), 1e6)));
  --row;
  const double at = rule.from + rule.step * (row->first - static_cast<double>(base));
  const bool last = std::next(row) == rows.end();
  const double grows = last ? 0 : row->second[rule.slope] * std::abs(position - at);
  return limited(rule.value, row->second[rule.start] + grows);
}

void Device::moved(const Position& from, const Position& to) {
  for (std::size_t i = 0; i < kAxes; ++i)
    if (to[i] != from[i]) direction_[i] = to[i] - from[i];
}

double Device::noise(double deviation) {
  if (!(deviation > 0)) return 0;
  // Twelve even numbers make a bell.
  std::uint64_t state = mixed(file_.seed ^ mixed(++draws_));
  double sum = -6;
  for (int n = 0; n < 12; ++n) {
    state = mixed(state);
    sum += static_cast<double>(state >> 11) / 9007199254740992.0; // 2^53
  }
  return sum * deviation;
}

Position Device::shiftAt(const Position& machine) {
  Position out{};
  for (const DeviceError& error : file_.errors) {
    if (!moves(error.moving, error.along.axis)) continue;
    const double position = machine[error.along.axis] - error.along.zero;
    out[error.axis] -= error.table.at(position, error.value ? values_[*error.value] : 0) + noise_;
  }
  return out;
}

void Device::touchBegins() {
  noise_ = 0;
  for (const DeviceError& error : file_.errors)
    if (moves(error.moving, error.along.axis)) noise_ += noise(error.noise);
  for (std::size_t i = 0; i < values_.size(); ++i)
    if (settles_[i] > kNow)
      say(fmt::format("a move looks for contact {} before `{}` of {} has settled", seconds(settles_[i]),
                      file_.values[i].name, setBy_[i]),
          "what it reads lies between the old and the new value");
}

void Device::touched(const Position& machine) {
  for (const DeviceError& error : file_.errors) {
    if (!moves(error.moving, error.along.axis)) continue;
    const double position = machine[error.along.axis] - error.along.zero;
    const double value = error.value ? values_[*error.value] : 0;
    if (!error.table.covers(position, value))
      say(fmt::format("the table of errors has no point at {} mm{}", numberText(position),
                      error.value
                          ? fmt::format(" and {} {}", numberText(value), file_.values[*error.value].unit)
                          : ""),
          "the run takes the error at the nearest end of the table", false);
    const DeviceTouch now{position, values_, machine[error.axis], -shiftAt(machine)[error.axis]};
    // A macro touches fast and then slowly: the last touch of a place counts.
    if (!touches_.empty() && touches_.back().position == position && touches_.back().values == values_)
      touches_.back() = now;
    else if (touches_.size() < kMostTouches)
      touches_.push_back(now);
    return;
  }
}

} // namespace dotek::sim
