// Cycles by the touches that they consist of: what G31 alone can do.
#include "backends/common/CycleTouches.h"
#include "backends/mikroprog/State.h"
#include "stdlib/MacroCycle.h"
#include "support/messages/Fanuc.h"
#include "support/messages/Mikroprog.h"

#include <algorithm>
#include <fmt/format.h>

namespace dotek::backends::mikroprog {

namespace {

constexpr std::string_view kNoArithmetic =
    "the control compares and computes nothing with what was measured; take it out of the call";

const ir::CycleArgument* find(const ir::CallCycle& cycle, std::string_view parameter) {
  const auto found = std::find_if(cycle.arguments.begin(), cycle.arguments.end(),
                                  [&](const auto& one) { return one.parameter == parameter; });
  return found == cycle.arguments.end() ? nullptr : &*found;
}

// Refuses every parameter that is none of `taken`.
bool takes(State& state, const ir::CallCycle& cycle, const std::vector<std::string>& taken,
           SourceRange range) {
  bool out = true;
  for (const ir::CycleArgument& argument : cycle.arguments) {
    if (std::find(taken.begin(), taken.end(), argument.parameter) != taken.end()) continue;
    state.refuse<diag::MikroprogCannot>(range, "the " + argument.parameter + " of the call",
                                        std::string(kNoArithmetic));
    out = false;
  }
  return out;
}

// The setting with a nominal along each axis that it changes: where the feature is expected.
std::optional<ir::OffsetSetting> settingOf(State& state, const ir::CallCycle& cycle,
                                           const std::optional<ir::Coordinate>& target, SourceRange range) {
  ir::OffsetSetting out{cycle.setting->system, cycle.setting->nominal};
  for (const ir::Axis axis : ir::kAxes) {
    const std::size_t i = ir::indexOf(axis);
    if (!cycle.setting->axes[i] || out.nominal[i] != nullptr) continue;
    const std::optional<double> place =
        target ? placeOf(state, *target, axis, range) : hereOf(state, axis, range);
    if (!place) return std::nullopt;
    out.nominal[i] = ir::constant(*place, range);
  }
  return out;
}

} // namespace

void cycle(State& state, const ir::CallCycle& cycle, std::size_t index) {
  const ir::Origin& origin = state.cycle.body[index].origin;
  const SourceRange range = origin.range();
  if (const std::vector<ir::Measure> touches = touchesOf(cycle); !touches.empty()) {
    state.oneOfSeveral = true;
    for (const ir::Measure& touch : touches)
      mikroprog::measure(state, touch, index);
    state.oneOfSeveral = false;
    return;
  }
  const bool surface = cycle.cycle == stdlib::intentName(stdlib::Intent::Surface);
  const bool pocket = cycle.cycle == stdlib::intentName(stdlib::Intent::Pocket);
  const bool bore = cycle.cycle == stdlib::intentName(stdlib::Intent::Bore);
  if (!surface && !pocket && !bore) {
    std::string what = cycle.cycle;
    std::replace(what.begin(), what.end(), '-', ' ');
    state.refuse<diag::MikroprogCannot>(range, "the measurement `" + what + "`",
                                        "Dotek writes surfaces, pockets, bores and inner corners for it; "
                                        "print touches of single surfaces instead");
    return;
  }
  const std::string overtravel(stdlib::roleName(stdlib::ArgumentRole::Overtravel));
  const std::string letter = cycle.axis ? std::string(1, "xyz"[ir::indexOf(*cycle.axis)]) : "";
  const std::string size =
      surface  ? std::string(stdlib::roleName(stdlib::ArgumentRole::Target)) + " " + letter
      : pocket ? std::string(stdlib::roleName(stdlib::ArgumentRole::Width)) + " " + letter
               : std::string(stdlib::roleName(stdlib::ArgumentRole::Diameter));
  if (!takes(state, cycle, {overtravel, size}, range)) return;
  const ir::CycleArgument* given = find(cycle, size);
  if (given == nullptr) {
    state.refuse<diag::MikroprogCannot>(range, "the " + size + " is not given", "the call has to state it");
    return;
  }
  std::optional<ir::Coordinate> target;
  if (surface) target = ir::Coordinate{given->value, given->frame.value_or(ir::Frame::Work), nullptr};
  std::optional<ir::OffsetSetting> setting;
  if (cycle.setting) {
    setting = settingOf(state, cycle, target, range);
    if (!setting) return;
  }
  if (const ir::CycleArgument* over = find(cycle, overtravel)) {
    state.overtravelGiven = rangedValueOf(state, 'Q', over->value, "the overtravel", true, range);
    if (!state.overtravelGiven) return;
  }
  if (surface) {
    ir::Measure measure;
    measure.axis = *cycle.axis;
    measure.target = std::move(target);
    measure.setting = std::move(setting);
    mikroprog::measure(state, measure, index);
  } else if (pocket) {
    middle(state, {*cycle.axis}, {"pocket", "a width"}, given->value, setting, origin);
  } else {
    middle(state, {ir::Axis::X, ir::Axis::Y}, {"bore", "a diameter"}, given->value, setting, origin);
  }
  state.overtravelGiven.reset();
}

} // namespace dotek::backends::mikroprog
