// Statements of the cycle language that the IR has as cycles by their names.
#include "ir/CycleNames.h"
#include "sim/cycle/CycleRun.h"
#include "sim/machine/Measurement.h"
#include "support/Decimal.h"

#include <cmath>
#include <fmt/format.h>

namespace dotek::sim {

namespace {

constexpr std::size_t kZ = 2;
constexpr double kNothing = 1e-6; // mm
constexpr int kDecimals = 6;      // of lines of the trace

// "target x": of an axis.
std::string ofAxis(std::string_view what, std::size_t axis) {
  return fmt::format("{} {}", what, "xyz"[axis]);
}

const ir::CycleArgument* argumentOf(const ir::CallCycle& node, std::string_view name) {
  for (const ir::CycleArgument& argument : node.arguments)
    if (argument.parameter == name) return &argument;
  return nullptr;
}

} // namespace

bool CycleRun::read(const ir::CallCycle& node, std::string_view name, std::optional<double>& value) {
  const ir::CycleArgument* const argument = argumentOf(node, name);
  if (argument == nullptr) return true;
  value = number(argument->value);
  return value.has_value();
}

bool CycleRun::call(const ir::CallCycle& node) {
  if (!node.set.empty())
    return inconclusive(fmt::format(
        "what the cycle `{}` of the macros `{}` consists of is written in no cycle", node.cycle, node.set));
  if (node.cycle == ir::kSetOffset) return setOffset(node);
  if (node.cycle == ir::kSetTool) return setTool(node);
  if (node.cycle == ir::kReport) return report(node);
  if (node.cycle == ir::kSurface) return callSurface(node);
  if (node.cycle == ir::kSurfaceAlong) return callSurfaceAlong(node);
  const bool keeps = node.cycle == ir::kKeep;
  if (!keeps && node.cycle != ir::kResults)
    return inconclusive(fmt::format("what the cycle `{}` consists of is not known", node.cycle));
  for (const ir::CycleArgument& argument : node.arguments) {
    const std::optional<double> value = number(argument.value);
    if (!value) return false;
    if (keeps)
      machine_.remark("stored", fmt::format("{} {}", argument.parameter, fixedText(*value, kDecimals)));
    else
      left_.emplace_back(argument.parameter, *value);
  }
  return true;
}

// All values are read before anything changes.
bool CycleRun::setOffset(const ir::CallCycle& node) {
  if (!node.setting) return inconclusive("the offset that is set is not named");
  std::array<std::optional<double>, 3> measured;
  for (std::size_t i = 0; i < measured.size(); ++i)
    if (!read(node, ofAxis("measured", i), measured[i])) return false;
  return set({node.setting->system, node.setting->nominal}, measured);
}

bool CycleRun::hasTool(std::optional<double> tool) {
  if (tool && *tool >= 1 && *tool <= kMostTool && *tool == std::floor(*tool)) return true;
  return raise(fmt::format("there is no tool offset {}", tool ? numberText(*tool) : "without a number"));
}

namespace {

// Of the table of the machine that a cycle runs on (CycleMachine.h).
std::uint32_t variableOf(std::uint32_t tool, ir::ToolPart part) {
  return static_cast<std::uint32_t>(ir::kToolTable + ir::kToolPartStep * static_cast<double>(part)) + tool;
}

ir::ToolPart wearOf(ir::ToolPart part) {
  return isLength(part) ? ir::ToolPart::LengthWear : ir::ToolPart::RadiusWear;
}

} // namespace

double CycleRun::toolValue(std::uint32_t tool, ir::ToolPart part) const {
  const double own = machine_.read(variableOf(tool, part)).value_or(0);
  return isWear(part) ? own : own + machine_.read(variableOf(tool, wearOf(part))).value_or(0);
}

bool CycleRun::writeTool(std::uint32_t tool, ir::ToolPart part, double value) {
  if (isWear(part)) {
    machine_.remark("tool-offset",
                    fmt::format("{} {} {}", tool, toolPartText(part), fixedText(value, kDecimals)));
    return machine_.write(variableOf(tool, part), value);
  }
  const bool radius = part == ir::ToolPart::Radius;
  machine_.writeTool(tool, radius, value);
  // Reported as one value; its parts are kept for what reads them.
  return !radius || (machine_.preset(variableOf(tool, part), value) &&
                     machine_.preset(variableOf(tool, wearOf(part)), 0));
}

bool CycleRun::setTool(const ir::CallCycle& node) {
  std::optional<double> tool;
  if (!read(node, "tool", tool) || !hasTool(tool)) return false;
  for (const ir::ToolPart part : ir::kToolParts) {
    std::optional<double> value;
    if (!read(node, toolPartText(part), value)) return false;
    if (value && !writeTool(static_cast<std::uint32_t>(*tool), part, *value)) return false;
  }
  return true;
}

// The comment before it is its name.
bool CycleRun::report(const ir::CallCycle& node) {
  std::optional<double> measured, nominal, tolerance;
  if (!read(node, "measured", measured) || !read(node, "nominal", nominal) ||
      !read(node, "tolerance", tolerance))
    return false;
  if (!measured) return inconclusive("the report has no value");
  std::string text = fmt::format("\"{}\" measured {}", comment_, fixedText(*measured, kDecimals));
  if (nominal) text += fmt::format(" nominal {}", fixedText(*nominal, kDecimals));
  if (tolerance) text += fmt::format(" tolerance {}", fixedText(*tolerance, kDecimals));
  machine_.remark("report", text);
  if (MotionWatcher* const watcher = this->watcher(); watcher != nullptr)
    watcher->reported({0, "report", {{comment_, nominal, *measured}}});
  return true;
}

bool CycleRun::callSurface(const ir::CallCycle& node) {
  std::optional<double> overtravel, once, miss;
  if (!read(node, "overtravel", overtravel) || !read(node, "once", once) || !read(node, "miss", miss))
    return false;
  const std::size_t i = ir::indexOf(node.axis.value_or(ir::Axis::X));
  const ir::CycleArgument* const target = argumentOf(node, ofAxis("target", i));
  if (target == nullptr) return inconclusive("where the surface is expected is not said");
  const std::optional<double> expected = coordinate(
      {target->value, target->frame.value_or(ir::Frame::Here), nullptr}, i, ir::ProbePoint::Lowest);
  if (!expected) return false;
  if (overtravel && *overtravel < 0) return raise("an overtravel below 0");
  results_.clear();
  const Search how{overtravel.value_or(inputs_.overtravel), overtravel.has_value(), once.value_or(0) != 0,
                   miss.value_or(0) != 0};
  std::array<std::optional<double>, 3> found;
  if (!touchAxis(i, *expected, how, found[i])) return false;
  results_[ir::ResultName::ProbeError] = found[i] ? 0 : 1;
  if (node.setting && found[i] && !set({node.setting->system, node.setting->nominal}, found)) return false;
  end();
  return true;
}

bool CycleRun::callSurfaceAlong(const ir::CallCycle& node) {
  std::optional<double> travel, overtravel, once, miss;
  std::array<std::optional<double>, 3> parts;
  for (std::size_t i = 0; i < parts.size(); ++i)
    if (!read(node, ofAxis("direction", i), parts[i])) return false;
  if (!read(node, "travel", travel) || !read(node, "overtravel", overtravel) || !read(node, "once", once) ||
      !read(node, "miss", miss))
    return false;
  const double length = std::hypot(parts[0].value_or(0), parts[1].value_or(0), parts[kZ].value_or(0));
  if (!(length > 0)) return raise("a direction of no length");
  if (!travel || std::abs(*travel) < kNothing)
    return raise("the surface is expected where the probe is; which way it lies is not known");
  if (overtravel && *overtravel < 0) return raise("an overtravel below 0");
  Direction direction{};
  for (std::size_t i = 0; i < parts.size(); ++i)
    direction[i] = parts[i].value_or(0) / length * (*travel > 0 ? 1 : -1) + 0.0;
  results_.clear();
  const Search how{overtravel.value_or(inputs_.overtravel), overtravel.has_value(), once.value_or(0) != 0,
                   miss.value_or(0) != 0};
  PlannedTouch planned = plan(direction, std::abs(*travel), how);
  // Straight down the way counts from the lowest point.
  const double low = planned.isDown() ? inputs_.ballRadius : 0;
  planned.distance -= low;
  begin({&planned, 1});
  Touched touched;
  if (!touch(planned, how, touched)) return false;
  results_[ir::ResultName::ProbeError] = touched.found ? 0 : 1;
  if (!touched.found) {
    if (!how.mayMiss) return notFound();
    end();
    return true;
  }
  constexpr ir::ResultName kPositions[] = {ir::ResultName::PositionX, ir::ResultName::PositionY,
                                           ir::ResultName::PositionZ};
  const double ball = ballAlong(planned);
  double along = 0;
  Measurement found{0, "surface along a direction", {}};
  for (std::size_t i = 0; i < direction.size(); ++i) {
    along += (touched.at[i] - planned.from[i]) * direction[i];
    // From the lowest point up to the centre, unless that point touches.
    const double up = i == kZ && !planned.isDown() ? inputs_.ballRadius : 0;
    const double at = touched.at[i] + up + direction[i] * ball;
    results_[kPositions[i]] = at;
    found.values.push_back(
        {std::string(1, "XYZ"[i]), planned.from[i] + up + direction[i] * planned.distance, at});
  }
  results_[ir::ResultName::Main] = along + ball - planned.distance;
  if (MotionWatcher* const watcher = this->watcher(); watcher != nullptr) watcher->measured(found);
  end();
  return true;
}

} // namespace dotek::sim
