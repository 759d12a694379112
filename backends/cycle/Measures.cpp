// Touches, and calls of cycles of the library in the place of a vendor's.
#include "backends/cycle/MeasureCall.h"
#include "ir/CycleNames.h"

#include <algorithm>
#include <fmt/format.h>

namespace dotek::backends::cycle {

using stdlib::ArgumentRole;
using stdlib::Intent;

std::string smallLetter(ir::Axis axis) {
  return std::string(1, "xyz"[ir::indexOf(axis)]);
}

void writeSetting(State& state, const Setting& setting, const std::array<std::string, 3>& found,
                  const ir::Origin& origin) {
  std::string items;
  for (const ir::Axis axis : ir::kAxes) {
    const std::size_t i = ir::indexOf(axis);
    if (setting.nominal[i].empty()) continue;
    if (found[i].empty())
      return state.refuse(origin.range(), fmt::format("an offset in {} of this feature", ir::letterOf(axis)),
                          "set the axes that it measures");
    items += fmt::format("{}{} becomes {} {}", items.empty() ? "" : ", ", found[i], smallLetter(axis),
                         setting.nominal[i]);
  }
  if (items.empty()) return;
  state.add(fmt::format("set {}: {}", setting.system, items), origin);
  // What has been reached has other coordinates where the active offset was set.
  for (const ir::Axis axis : ir::kAxes)
    if (!setting.nominal[ir::indexOf(axis)].empty()) state.at[ir::indexOf(axis)].clear();
}

namespace {

std::optional<Setting> settingOf(State& state, const ir::OffsetSetting& setting, SourceRange range) {
  Setting out{systemText(state, setting.system, range), {}};
  if (out.system.empty()) return std::nullopt;
  for (const ir::Axis axis : ir::kAxes) {
    const ir::ExpressionPtr& nominal = setting.nominal[ir::indexOf(axis)];
    if (nominal == nullptr) continue;
    std::string& text = out.nominal[ir::indexOf(axis)];
    text = valueText(state, nominal, ir::Kind::Length, range);
    if (text.empty()) return std::nullopt;
  }
  return out;
}

// `overtravel`: "" for that of the machine.
std::string writeTouch(State& state, ir::Axis axis, const ir::Coordinate& target,
                       const std::string& overtravel, const std::string& name, const ir::Origin& origin) {
  const bool travel = target.frame == ir::Frame::Here;
  const std::string to = travel ? valueText(state, target.value, ir::Kind::Length, origin.range())
                                : workText(state, target, axis, origin.range());
  if (to.empty()) return "";
  const std::string touched = state.fresh(name);
  state.add(fmt::format("touch {} {} {}{} -> {}", smallLetter(axis), travel ? "by" : "to", to,
                        overtravel.empty() ? "" : " overtravel " + overtravel, touched),
            origin);
  return touched;
}

void leaves(State& state, const std::string& touched, ir::Axis axis) {
  state.measured.clear();
  state.measured[kPositions[ir::indexOf(axis)]] = touched + ".at";
  state.measured[kErrors[ir::indexOf(axis)]] = touched + ".error";
  state.measured[ir::ResultName::Main] = touched + ".at";
}

void leavesHollow(State& state, const std::string& called, const std::vector<ir::Axis>& axes,
                  const std::string& deviation) {
  state.measured.clear();
  for (const ir::Axis axis : axes) {
    const std::string centre = called + (axes.size() > 1 ? ".centre_" + smallLetter(axis) : ".centre");
    state.measured[kPositions[ir::indexOf(axis)]] = centre;
    state.measured[kErrors[ir::indexOf(axis)]] = centre + " - " + hereText(state, axis);
  }
  state.measured[ir::ResultName::Size] = state.measured[ir::ResultName::Main] = called + ".size";
  state.measured[ir::ResultName::SizeError] = deviation;
}

} // namespace

void MeasureCall::write() {
  const auto is = [&](Intent intent) { return call_.cycle == stdlib::intentName(intent); };
  if (is(Intent::Surface)) return surface();
  if (is(Intent::InnerCorner)) return innerCorner();
  if (is(Intent::Bore)) return hollow("bore", {ir::Axis::X, ir::Axis::Y}, false);
  if (is(Intent::Boss)) return hollow("boss", {ir::Axis::X, ir::Axis::Y}, true);
  if (call_.axis && is(Intent::Pocket))
    return hollow("channel_" + smallLetter(*call_.axis), {*call_.axis}, false);
  if (call_.axis && is(Intent::Web)) return hollow("web_" + smallLetter(*call_.axis), {*call_.axis}, true);
  if (is(Intent::AngledSurface)) return angledSurface();
  if (is(Intent::AngledPocket)) return angledPair(false);
  if (is(Intent::AngledWeb)) return angledPair(true);
  if (is(Intent::ThreePointBore)) return threePoints(false);
  if (is(Intent::ThreePointBoss)) return threePoints(true);
  if (call_.axis && is(Intent::Angle)) return faceAngle();
  std::string what = call_.cycle;
  std::replace(what.begin(), what.end(), '-', ' ');
  state_.refuse(range_, fmt::format("the measurement `{}` of the macros", what),
                "surfaces, circles, pockets, webs, inner corners and angles of faces come over; write this "
                "one with touches, or call a cycle of `dotek list cycles`");
}

const ir::CycleArgument* MeasureCall::find(const std::string& parameter) {
  const auto found = std::find_if(call_.arguments.begin(), call_.arguments.end(),
                                  [&](const auto& one) { return one.parameter == parameter; });
  if (found == call_.arguments.end()) return nullptr;
  known_.insert(parameter);
  return &*found;
}
std::string MeasureCall::text(const ir::CycleArgument* argument, ir::Kind kind) {
  return argument == nullptr ? "" : valueText(state_, argument->value, kind, range_);
}
ir::Coordinate MeasureCall::coordinate(const ir::CycleArgument& argument) {
  return {argument.value, argument.frame.value_or(ir::Frame::Work), nullptr};
}

// Whatever was not looked at has no counterpart.
bool MeasureCall::tookAll() {
  for (const ir::CycleArgument& one : call_.arguments) {
    if (known_.contains(one.parameter)) continue;
    if (stdlib::isPrintout(one.parameter)) {
      state_.note(range_, "the printout that the call asks for",
                  "`report` prints in a cycle, where it is wanted");
      continue;
    }
    std::string what = one.parameter;
    std::replace(what.begin(), what.end(), '-', ' ');
    state_.refuse(range_, fmt::format("the {} of the call", what),
                  "what the macros do with it is no part of the language; decide on what was measured "
                  "(`if`, `alarm`), or take it out of the call");
    return false;
  }
  return true;
}

// `expected`: where the feature is, along each axis.
std::optional<Setting> MeasureCall::setting(const std::array<std::string, 3>& expected) {
  Setting out{systemText(state_, call_.setting->system, range_), {}};
  if (out.system.empty()) return std::nullopt;
  for (const ir::Axis axis : ir::kAxes) {
    const std::size_t i = ir::indexOf(axis);
    if (!call_.setting->axes[i]) continue;
    out.nominal[i] = call_.setting->nominal[i] == nullptr
                         ? expected[i]
                         : valueText(state_, call_.setting->nominal[i], ir::Kind::Length, range_);
    if (out.nominal[i].empty()) return std::nullopt;
  }
  return out;
}

void MeasureCall::alarmBeyond(const std::string& value, const std::string& limit, std::string_view message) {
  state_.add(fmt::format("if abs({}) > {} then", value, limit), origin_);
  state_.add(fmt::format("alarm{}", quoted(message)), origin_);
  state_.add("end", origin_);
}

void MeasureCall::surface() {
  const ir::Axis axis = *call_.axis;
  const ir::CycleArgument* target = find(ArgumentRole::Target, axis);
  const std::string overtravel = text(find(ArgumentRole::Overtravel));
  const ir::CycleArgument* limit = find(ArgumentRole::UpperLimit);
  const std::string tolerance = text(find(ArgumentRole::SizeTolerance));
  const std::string zone = text(find(ArgumentRole::PositionTolerance));
  if (target == nullptr)
    return state_.refuse(range_, "a surface without a place", "state where it is expected");
  if (!tookAll()) return;
  std::array<std::string, 3> expected;
  expected[ir::indexOf(axis)] = workText(state_, coordinate(*target), axis, range_);
  std::optional<Setting> set;
  if (call_.setting && !(set = setting(expected))) return;
  const std::string touched =
      writeTouch(state_, axis, coordinate(*target), overtravel, "surface_" + smallLetter(axis), origin_);
  if (touched.empty()) return;
  leaves(state_, touched, axis);
  if (limit != nullptr) alarmBeyond(touched + ".error", text(limit), "The surface is beyond the limit");
  if (!tolerance.empty()) alarmBeyond(touched + ".error", tolerance, "The surface is out of tolerance");
  if (!zone.empty())
    alarmBeyond("2 * " + touched + ".error", zone, "The surface is outside its position tolerance");
  std::array<std::string, 3> found;
  found[ir::indexOf(axis)] = touched + ".at";
  if (set) writeSetting(state_, *set, found, origin_);
}

void MeasureCall::innerCorner() {
  const std::string overtravel = text(find(ArgumentRole::Overtravel));
  std::array<std::string, 3> expected, found;
  std::vector<std::pair<ir::Axis, const ir::CycleArgument*>> faces;
  for (const ir::Axis axis : {ir::Axis::X, ir::Axis::Y})
    if (const ir::CycleArgument* target = find(ArgumentRole::Target, axis)) {
      faces.emplace_back(axis, target);
      expected[ir::indexOf(axis)] = workText(state_, coordinate(*target), axis, range_);
    }
  if (!tookAll()) return;
  std::optional<Setting> set;
  if (call_.setting && !(set = setting(expected))) return;
  state_.measured.clear();
  std::map<ir::ResultName, std::string> left;
  for (const auto& [axis, target] : faces) {
    const std::string touched =
        writeTouch(state_, axis, coordinate(*target), overtravel, "face_" + smallLetter(axis), origin_);
    if (touched.empty()) return;
    found[ir::indexOf(axis)] = touched + ".at";
    left[kPositions[ir::indexOf(axis)]] = touched + ".at";
    left[kErrors[ir::indexOf(axis)]] = touched + ".error";
  }
  state_.measured = std::move(left);
  if (set) writeSetting(state_, *set, found, origin_);
}

// Where it begins gets a name: what follows leads away from there.
void MeasureCall::keepHere(const std::vector<ir::Axis>& axes) {
  for (const ir::Axis axis : axes) {
    const std::size_t i = ir::indexOf(axis);
    if (!state_.at[i].empty()) continue;
    const std::string middle = state_.fresh("middle_" + smallLetter(axis));
    state_.add(fmt::format("{} = here.{}", middle, smallLetter(axis)), origin_);
    state_.helpers.push_back(middle);
    state_.at[i] = middle;
  }
}

std::string MeasureCall::wayDown() {
  const ir::CycleArgument* depth = find(ArgumentRole::Depth);
  const std::string clearance = text(find(ArgumentRole::Clearance));
  if (depth == nullptr || clearance.empty()) {
    state_.refuse(range_, "a feature from outside without depth or clearance", "state both in the call");
    return "";
  }
  const std::string down = workText(state_, coordinate(*depth), ir::Axis::Z, range_);
  if (down.empty()) return "";
  return fmt::format("depth = {} - {}, clearance = {}", hereText(state_, ir::Axis::Z),
                     down.find(' ') == std::string::npos ? down : "(" + down + ")", clearance);
}

// What has a middle. `beside`: the probe goes down outside of it.
void MeasureCall::hollow(const std::string& cycle, const std::vector<ir::Axis>& axes, bool beside) {
  const bool round = axes.size() > 1;
  const ir::CycleArgument* size =
      round ? find(ArgumentRole::Diameter) : find(ArgumentRole::Width, axes.front());
  if (size == nullptr) return state_.refuse(range_, "a feature without a size", "state its size in the call");
  const std::string sizeText = text(size);
  const std::string overtravel = text(find(ArgumentRole::Overtravel));
  const std::string tolerance = text(find(ArgumentRole::SizeTolerance));
  const std::string zone = text(find(ArgumentRole::PositionTolerance));
  const std::string limit = text(find(ArgumentRole::UpperLimit));
  std::string arguments = fmt::format("{} = {}", round ? "diameter" : "width", sizeText);
  if (beside) {
    const std::string down = wayDown();
    if (down.empty()) return;
    arguments += ", " + down;
  }
  if (!tookAll()) return;
  if (sizeText.empty() || state_.failed) return;
  std::array<std::string, 3> expected, found;
  keepHere(axes);
  for (const ir::Axis axis : axes)
    expected[ir::indexOf(axis)] = hereText(state_, axis);
  std::optional<Setting> set;
  if (call_.setting && !(set = setting(expected))) return;
  if (!overtravel.empty()) {
    if (beside)
      return state_.refuse(range_, "the overtravel of this call", "a called cycle has the machine's");
    walls(axes, sizeText, overtravel, found);
    state_.measured[ir::ResultName::SizeError] =
        fmt::format("{} - {}", state_.measured[ir::ResultName::Size],
                    sizeText.find(' ') == std::string::npos ? sizeText : "(" + sizeText + ")");
    if (!tolerance.empty())
      alarmBeyond(state_.measured[ir::ResultName::SizeError], tolerance, "The size is out of tolerance");
  } else {
    const std::string name = state_.fresh(round ? (beside ? "boss" : "hole") : (beside ? "web" : "slot"));
    if (!tolerance.empty()) arguments += ", tolerance = " + tolerance;
    state_.add(fmt::format("call {} {} -> {}", cycle, arguments, name), origin_);
    leavesHollow(state_, name, axes, name + ".deviation");
    for (const ir::Axis axis : axes)
      found[ir::indexOf(axis)] = state_.measured[kPositions[ir::indexOf(axis)]];
  }
  if (!limit.empty()) {
    for (const ir::Axis axis : axes)
      alarmBeyond(fmt::format("{} - {}", found[ir::indexOf(axis)], expected[ir::indexOf(axis)]), limit,
                  "The middle is beyond the limit");
    alarmBeyond(state_.measured[ir::ResultName::SizeError], limit, "The size is beyond the limit");
  }
  if (!zone.empty()) alarmOutside(axes, found, expected, zone);
  if (set) writeSetting(state_, *set, found, origin_);
}

// The middle lies outside of its zone, whose diameter is given.
void MeasureCall::alarmOutside(const std::vector<ir::Axis>& axes, const std::array<std::string, 3>& found,
                               const std::array<std::string, 3>& expected, const std::string& zone) {
  constexpr std::string_view kText = "The middle is outside its position tolerance";
  const auto error = [&](ir::Axis axis) {
    return fmt::format("{} - {}", found[ir::indexOf(axis)], expected[ir::indexOf(axis)]);
  };
  if (axes.size() == 1) return alarmBeyond(fmt::format("2 * ({})", error(axes.front())), zone, kText);
  state_.add(
      fmt::format("if 2 * sqrt(square({}) + square({})) > {} then", error(axes[0]), error(axes[1]), zone),
      origin_);
  state_.add(fmt::format("alarm{}", quoted(kText)), origin_);
  state_.add("end", origin_);
}

// Two walls along each axis from the middle, with an overtravel of its own.
void MeasureCall::walls(const std::vector<ir::Axis>& axes, const std::string& size,
                        const std::string& overtravel, std::array<std::string, 3>& found) {
  const std::string half = size.find(" + ") == std::string::npos && size.find(" - ") == std::string::npos
                               ? size + " / 2"
                               : "(" + size + ") / 2";
  static constexpr const char* kNames[][2] = {{"right", "left"}, {"back", "front"}, {"", ""}};
  std::map<ir::ResultName, std::string> left;
  for (const ir::Axis axis : axes) {
    const std::size_t i = ir::indexOf(axis);
    const std::string one = state_.fresh(kNames[i][0]), other = state_.fresh(kNames[i][1]);
    const std::string letter = smallLetter(axis);
    state_.add(fmt::format("touch {} by {} overtravel {} -> {}", letter, half, overtravel, one), origin_);
    state_.add(fmt::format("touch {} by -{} overtravel {} -> {}", letter, half, overtravel, other), origin_);
    const std::string centre = state_.fresh("centre_" + letter);
    state_.add(fmt::format("{} = ({}.at + {}.at) / 2", centre, one, other), origin_);
    if (axes.size() > 1 && axis == axes.front())
      state_.add(fmt::format("protected move to {} {}", letter, centre), origin_,
                 "over the middle, as the macro goes");
    found[i] = centre;
    left[kPositions[i]] = centre;
    left[kErrors[i]] = centre + " - " + hereText(state_, axis);
    left[ir::ResultName::Size] = left[ir::ResultName::Main] = fmt::format("{}.at - {}.at", one, other);
  }
  if (axes.size() > 1)
    state_.add(
        fmt::format("protected move to {} {}", smallLetter(axes.front()), hereText(state_, axes.front())),
        origin_, "back to where the measurement began");
  state_.measured = std::move(left);
}

std::string hereText(const State& state, ir::Axis axis) {
  const std::string& at = state.at[ir::indexOf(axis)];
  return at.empty() ? "here." + smallLetter(axis) : at;
}

void writeMeasure(State& state, const ir::Measure& measure, const ir::Origin& origin) {
  const SourceRange range = origin.range();
  std::optional<Setting> set;
  if (measure.setting && !(set = settingOf(state, *measure.setting, range))) return;
  std::array<std::string, 3> found;
  if (measure.feature == ir::Feature::Bore) {
    const std::string diameter = valueText(state, measure.diameter, ir::Kind::Length, range);
    if (diameter.empty()) return;
    const std::string called = state.fresh("hole");
    state.add(fmt::format("call bore diameter = {} -> {}", diameter, called), origin);
    leavesHollow(state, called, {ir::Axis::X, ir::Axis::Y}, called + ".deviation");
    found[0] = called + ".centre_x";
    found[1] = called + ".centre_y";
  } else {
    if (!measure.target)
      return state.refuse(range, "a surface without a place", "state where it is expected");
    const std::string touched =
        writeTouch(state, measure.axis, *measure.target, "", "surface_" + smallLetter(measure.axis), origin);
    if (touched.empty()) return;
    leaves(state, touched, measure.axis);
    found[ir::indexOf(measure.axis)] = touched + ".at";
  }
  if (set) writeSetting(state, *set, found, origin);
}

namespace {

// `set`, as the source writes it by itself.
void writeOffset(State& state, const ir::CallCycle& call, const ir::Origin& origin) {
  const SourceRange range = origin.range();
  Setting set{systemText(state, call.setting->system, range), {}};
  if (set.system.empty()) return;
  std::array<std::string, 3> found;
  for (const ir::Axis axis : ir::kAxes) {
    const std::size_t i = ir::indexOf(axis);
    if (!call.setting->axes[i]) continue;
    const auto measured = std::find_if(call.arguments.begin(), call.arguments.end(), [&](const auto& one) {
      return one.parameter == "measured " + smallLetter(axis);
    });
    set.nominal[i] = valueText(state, call.setting->nominal[i], ir::Kind::Length, range);
    if (measured != call.arguments.end())
      found[i] = valueText(state, measured->value, ir::Kind::Length, range);
    if (set.nominal[i].empty() || found[i].empty()) return;
  }
  writeSetting(state, set, found, origin);
}

} // namespace

void writeCall(State& state, const ir::CallCycle& call, const ir::Origin& origin) {
  if (call.cycle == ir::kSetOffset) return writeOffset(state, call, origin);
  MeasureCall(state, call, origin).write();
}

} // namespace dotek::backends::cycle
