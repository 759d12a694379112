#include "sim/geometry/Devices.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <string_view>

namespace dotek::sim {

using stdlib::TomlDocument;
using stdlib::TomlTable;
using stdlib::TomlValue;

namespace {

constexpr double kMostLength = 2000; // mm
constexpr double kFarthest = 20000;
constexpr double kNear = 1e-6; // a path that ends at a touch begins the next one there
constexpr std::int64_t kMostTool = 999;

double size(const TomlDocument& document, const TomlTable& table, std::string_view key, std::string_view what,
            double least, double most) {
  const TomlValue value = table.require(key, what);
  const double out = value.number(most);
  if (value.isNumber() && !(out >= least && out <= most))
    document.fail(value.range(), fmt::format("`{}` is {}; {} to {} mm is expected", key, out, least, most));
  return out;
}

ToolSetter readSetter(const TomlDocument& document, const TomlTable& table) {
  ToolSetter out;
  const TomlValue at =
      table.require("at", "[X, Y, Z] of the middle of its upper face, in coordinates of the machine");
  const std::vector<double> place = at.numbers();
  if (place.size() == 3 &&
      std::all_of(place.begin(), place.end(), [](double n) { return std::abs(n) <= kFarthest; }))
    out.at = {place[0], place[1], place[2]};
  else if (at)
    document.fail(at.range(), "[X, Y, Z] in mm is expected");
  out.diameter = size(document, table, "diameter", "the diameter of the disc in mm", 0.1, 500);
  if (table.has("pre_travel")) out.preTravel = size(document, table, "pre_travel", "mm", 0, 5);
  out.overtravel = size(document, table, "overtravel", "how far it may be pushed, mm", 0.01, 100);
  if (out.overtravel <= out.preTravel)
    document.fail(table.value("overtravel").range(),
                  "`overtravel` is not more than `pre_travel`; no signal would come");
  static constexpr std::string_view kNames[] = {"-Z", "+X", "-X", "+Y", "-Y"};
  if (const TomlValue directions = table.value("directions")) {
    out.triggers.fill(false);
    for (const TomlValue& one : directions.items()) {
      const std::string name = one.choice({"-Z", "+X", "-X", "+Y", "-Y"});
      for (std::size_t i = 0; i < std::size(kNames); ++i)
        if (name == kNames[i]) out.triggers[i] = true;
    }
  }
  // Others are wired to inputs that a program reads in its own ways.
  table.require("signal", "\"skip\": its signal ends G31, as the probe's does").choice({"skip"});
  return out;
}

} // namespace

const CuttingTool* Devices::find(std::uint32_t number) const {
  const auto at =
      std::find_if(tools.begin(), tools.end(), [&](const CuttingTool& one) { return one.number == number; });
  return at == tools.end() ? nullptr : &*at;
}

// The tool goes up from its end without an end of its own, so that the end's middle must keep out of a
// cylinder that is as much wider as the tool is thick, from the upper face down.
std::optional<SetterTouch> firstTouch(const ToolSetter& setter, double toolRadius, const Point3& from,
                                      const Point3& to) {
  const double radius = setter.diameter / 2 + toolRadius;
  const Point3 way = to - from, begin = from - setter.at;
  const double apart = std::hypot(begin.x, begin.y);
  const auto side = [&](const Point3& at) {
    SetterTouch out;
    out.direction = std::abs(way.x) >= std::abs(way.y) ? (way.x > 0 ? ToolSetter::PlusX : ToolSetter::MinusX)
                                                       : (way.y > 0 ? ToolSetter::PlusY : ToolSetter::MinusY);
    const double length = std::max(std::hypot(at.x, at.y), kNear);
    out.normal = {at.x / length, at.y / length, 0};
    out.point = setter.at + out.normal * (setter.diameter / 2);
    out.point.z = std::min(setter.at.z, setter.at.z + at.z);
    return out;
  };
  const auto top = [&](const Point3& at) {
    SetterTouch out;
    out.normal = {0, 0, 1};
    out.point = setter.at + Point3{at.x, at.y, 0};
    return out;
  };
  std::optional<SetterTouch> first;
  if (begin.z <= kNear && apart < radius - kNear) {
    // Within: pushed from above, or from the side, whichever is nearer.
    const bool above = -begin.z <= radius - apart;
    const double deeper = above ? -way.z : -(way.x * begin.x + way.y * begin.y);
    if (deeper < 0 || (way.x == 0 && way.y == 0 && way.z >= 0)) return std::nullopt;
    first = above ? top(begin) : side(begin);
    first->atStart = true;
    return first;
  }
  if (begin.z > 0 && way.z < 0) {
    const double share = -begin.z / way.z;
    const Point3 at = begin + way * share;
    if (share <= 1 && std::hypot(at.x, at.y) <= radius) {
      first = top(at);
      first->share = share;
    }
  }
  const double a = way.x * way.x + way.y * way.y, b = begin.x * way.x + begin.y * way.y;
  const double root = b * b - a * (apart * apart - radius * radius);
  if (a > 0 && b < 0 && root >= 0) {
    const double share = std::max(0.0, (-b - std::sqrt(root)) / a);
    const Point3 at = begin + way * share;
    if (share <= 1 && at.z < -kNear && (!first || share < first->share)) {
      first = side(at);
      first->share = share;
    }
  }
  return first;
}

Devices readDevices(const TomlDocument& document, const TomlTable& root) {
  Devices out;
  if (const TomlValue tool = root.value("probe").table().value("tool"))
    out.probeTool = static_cast<std::uint32_t>(tool.integer(1, 1, kMostTool));
  for (const TomlTable& table : root.value("tool").tables()) {
    CuttingTool tool;
    const TomlValue number = table.require("number", "the number that T names");
    tool.number = static_cast<std::uint32_t>(number.integer(1, 1, kMostTool));
    tool.length =
        size(document, table, "length", "from the gauge line to its end, mm, as it is", 0.01, kMostLength);
    tool.diameter = size(document, table, "diameter", "mm", 0.01, 500);
    if (out.find(tool.number) != nullptr || tool.number == out.probeTool)
      document.fail(number.range(), fmt::format("tool {} is given twice", tool.number));
    out.tools.push_back(tool);
  }
  if (const TomlValue setter = root.value("tool_setter")) out.setter = readSetter(document, setter.table());
  return out;
}

} // namespace dotek::sim
