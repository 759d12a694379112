// Coordinates by their frames.
#include "backends/cycle/State.h"
#include "support/Decimal.h"

#include <fmt/format.h>

namespace dotek::backends::cycle {

namespace {

char small(ir::Axis axis) {
  return "xyz"[ir::indexOf(axis)];
}

// The value, as the second part of a sum.
std::string added(const std::string& base, const std::string& value) {
  if (value.empty()) return "";
  if (value == "0 mm") return base;
  if (value.starts_with('-') && value.find(" + ") == std::string::npos &&
      value.find(" - ") == std::string::npos)
    return base + " - " + value.substr(1);
  return base + " + " + value;
}

// A number that the source writes into a coordinate gets a name; 0 is one by itself.
std::string named(State& state, const ir::ExpressionPtr& value, ir::Axis axis, SourceRange range) {
  const double* constant = ir::constantValue(value);
  const std::string text = valueText(state, value, ir::Kind::Length, range);
  if (constant == nullptr || *constant == 0 || text.empty()) return text;
  const std::pair<int, double> key(static_cast<int>(ir::indexOf(axis)), *constant);
  const auto known = state.constants.find(key);
  if (known != state.constants.end()) return known->second;
  const std::string name = state.fresh(axis == ir::Axis::Z ? "height" : std::string("place_") + small(axis));
  state.named.push_back({fmt::format("{} = {}", name, text), {value->range}, "number of the source"});
  return state.constants.emplace(key, name).first->second;
}

} // namespace

std::string workText(State& state, const ir::Coordinate& coordinate, ir::Axis axis, SourceRange range) {
  if (coordinate.system != nullptr || coordinate.frame == ir::Frame::Machine) {
    state.refuse(range, fmt::format("{} in another system than the active one", ir::letterOf(axis)),
                 "count it in the active work offset");
    return "";
  }
  if (coordinate.frame == ir::Frame::Work) return named(state, coordinate.value, axis, range);
  const std::string value = valueText(state, coordinate.value, ir::Kind::Length, range);
  switch (coordinate.frame) {
  case ir::Frame::Start: return added(fmt::format("start.{}", small(axis)), value);
  case ir::Frame::Here: return added(fmt::format("here.{}", small(axis)), value);
  case ir::Frame::Retract: return added("retract", value);
  case ir::Frame::Work:
  case ir::Frame::Machine: break;
  }
  return value;
}

std::string placeText(State& state, const ir::Coordinate& coordinate, ir::Axis axis, SourceRange range) {
  std::string frame;
  if (coordinate.frame == ir::Frame::Machine) {
    frame = "machine ";
  } else if (coordinate.system != nullptr) {
    const std::string system = systemText(state, coordinate.system, range);
    if (system.empty()) return "";
    frame = "work " + system + " ";
  }
  const std::string value = frame.empty() ? workText(state, coordinate, axis, range)
                                          : valueText(state, coordinate.value, ir::Kind::Length, range);
  return value.empty() ? "" : fmt::format("{}{} {}", frame, small(axis), value);
}

} // namespace dotek::backends::cycle
