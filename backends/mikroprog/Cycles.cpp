// Cycles by the touches that they consist of: what G31 alone can do.
#include "backends/common/CycleTouches.h"
#include "backends/mikroprog/State.h"
#include "stdlib/MacroCycle.h"
#include "support/Decimal.h"
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
    if (stdlib::isPrintout(argument.parameter)) {
      state.diagnostics.report<diag::PrintLeftOut>(range, state.control.title);
      continue;
    }
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

// How a web or a boss is touched from outside; nothing: refused.
std::optional<Outside> outsideOf(State& state, const ir::CycleArgument* depth,
                                 const ir::CycleArgument* clearance, SourceRange range) {
  if (depth == nullptr || clearance == nullptr) {
    state.refuse<diag::MikroprogCannot>(
        range, fmt::format("the {} of the call is not given", depth == nullptr ? "depth" : "clearance"),
        "how far the probe keeps away from the feature on the way down is not known; print it");
    return std::nullopt;
  }
  const ir::Coordinate place{depth->value, depth->frame.value_or(ir::Frame::Work), nullptr};
  const std::optional<double> to = placeOf(state, place, ir::Axis::Z, range);
  const std::optional<double> away = to ? valueOf(state, clearance->value, range) : std::nullopt;
  if (!away) return std::nullopt;
  if (!(*away > 0)) {
    state.refuse<diag::MikroprogCannot>(range,
                                        fmt::format("a clearance of {} from within", numberText(*away)),
                                        "Dotek writes features that are touched from outside for it");
    return std::nullopt;
  }
  return Outside{*away, *to};
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
  if (cycle.cycle == stdlib::intentName(stdlib::Intent::InnerCorner)) {
    const std::string target(stdlib::roleName(stdlib::ArgumentRole::Target));
    if (takes(state, cycle, {target + " x", target + " y"}, range))
      state.refuse<diag::MikroprogCannot>(range,
                                          "an inner corner whose two surfaces the call does not both state",
                                          "print touches of single surfaces instead");
    return;
  }
  const bool surface = cycle.cycle == stdlib::intentName(stdlib::Intent::Surface);
  const bool pocket = cycle.cycle == stdlib::intentName(stdlib::Intent::Pocket);
  const bool web = cycle.cycle == stdlib::intentName(stdlib::Intent::Web);
  const bool bore = cycle.cycle == stdlib::intentName(stdlib::Intent::Bore);
  const bool boss = cycle.cycle == stdlib::intentName(stdlib::Intent::Boss);
  const bool outside = web || boss;
  if (!surface && !pocket && !bore && !outside) {
    std::string what = cycle.cycle;
    std::replace(what.begin(), what.end(), '-', ' ');
    const bool corner = cycle.cycle == stdlib::intentName(stdlib::Intent::InnerCorner);
    state.refuse<diag::MikroprogCannot>(
        range, corner ? "an inner corner with a second touch of a face" : "the measurement `" + what + "`",
        "Dotek writes surfaces, pockets, webs, bores, bosses and inner corners "
        "for it; print touches of single surfaces instead");
    return;
  }
  const std::string overtravel(stdlib::roleName(stdlib::ArgumentRole::Overtravel));
  const std::string letter = cycle.axis ? std::string(1, "xyz"[ir::indexOf(*cycle.axis)]) : "";
  const std::string size =
      surface         ? std::string(stdlib::roleName(stdlib::ArgumentRole::Target)) + " " + letter
      : pocket || web ? std::string(stdlib::roleName(stdlib::ArgumentRole::Width)) + " " + letter
                      : std::string(stdlib::roleName(stdlib::ArgumentRole::Diameter));
  const std::string depth(stdlib::roleName(stdlib::ArgumentRole::Depth)),
      clearance(stdlib::roleName(stdlib::ArgumentRole::Clearance));
  std::vector<std::string> taken = {overtravel, size};
  if (outside) taken.insert(taken.end(), {depth, clearance});
  if (!takes(state, cycle, taken, range)) return;
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
  std::optional<Outside> beside;
  if (outside) {
    beside = outsideOf(state, find(cycle, depth), find(cycle, clearance), range);
    if (!beside) return;
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
  } else if (pocket || web) {
    middle(state, {*cycle.axis}, {web ? "web" : "pocket", "a width", beside}, given->value, setting, origin);
  } else {
    middle(state, {ir::Axis::X, ir::Axis::Y}, {boss ? "boss" : "bore", "a diameter", beside}, given->value,
           setting, origin);
  }
  state.overtravelGiven.reset();
}

} // namespace dotek::backends::mikroprog
