#include "backends/common/MacroCall.h"

#include "ir/Fold.h"
#include "ir/Linear.h"

#include <algorithm>

namespace dotek::backends {

namespace {

constexpr double kBeforeFirstSystem = 53; // SystemCode::Index 1 is G54

ir::ExpressionPtr systemNumber(const stdlib::MacroArgument& argument, const ir::ExpressionPtr& system) {
  if (argument.systemCode == stdlib::SystemCode::GNumber) return system;
  return ir::simplify(
      ir::binary(ir::BinaryOp::Subtract, system, ir::constant(kBeforeFirstSystem), system->range));
}

ir::ExpressionPtr valueOf(const stdlib::MacroArgument& argument, const ir::Measure& measure,
                          const CallValues& values) {
  switch (argument.role) {
  case stdlib::ArgumentRole::Target:
    return measure.target ? values.place(*measure.target, argument.axis, argument.frame) : nullptr;
  case stdlib::ArgumentRole::Diameter: return measure.diameter;
  case stdlib::ArgumentRole::Overtravel: return values.overtravel ? values.overtravel() : nullptr;
  case stdlib::ArgumentRole::Nominal:
    return measure.setting ? measure.setting->nominal[ir::indexOf(argument.axis)] : nullptr;
  case stdlib::ArgumentRole::System:
    return measure.setting && values.setsSystem ? systemNumber(argument, measure.setting->system) : nullptr;
  default: return nullptr; // a cycle says nothing of it
  }
}

ir::ExpressionPtr valueOf(const stdlib::MacroArgument& argument, const ir::Move& move,
                          const CallValues& values) {
  if (argument.role == stdlib::ArgumentRole::Feed) return move.feed;
  if (argument.role != stdlib::ArgumentRole::Target) return nullptr;
  const auto& coordinate = move.axes[ir::indexOf(argument.axis)];
  return coordinate ? values.place(*coordinate, argument.axis, argument.frame) : nullptr;
}

template <class Node>
MacroCall callOf(const stdlib::MacroSignature& signature, const Node& node, const CallValues& values) {
  MacroCall out;
  out.signature = &signature;
  for (const stdlib::MacroArgument& argument : signature.arguments) {
    if (ir::ExpressionPtr value = valueOf(argument, node, values))
      out.arguments.push_back({&argument, std::move(value)});
    else if (argument.required)
      out.missing.push_back(&argument);
  }
  return out;
}

// What the measurement is about.
ir::ResultName ownResult(const ir::Measure& measure) {
  constexpr ir::ResultName kPositions[] = {ir::ResultName::PositionX, ir::ResultName::PositionY,
                                           ir::ResultName::PositionZ};
  return measure.feature == ir::Feature::Bore ? ir::ResultName::Size : kPositions[ir::indexOf(measure.axis)];
}

} // namespace

const stdlib::MacroSignature* signatureOf(const stdlib::MacroSet& macros, const ir::Measure& measure) {
  return macros.find(measure.feature == ir::Feature::Bore ? stdlib::Intent::Bore : stdlib::Intent::Surface,
                     measure.axis);
}

std::string featureName(const ir::Measure& measure) {
  if (measure.feature == ir::Feature::Bore) return "a bore";
  return std::string("a surface along ") + ir::letterOf(measure.axis);
}

std::vector<ir::Axis> measuredAxes(const ir::Measure& measure) {
  if (measure.feature == ir::Feature::Bore) return {ir::Axis::X, ir::Axis::Y};
  return {measure.axis};
}

bool setsAnotherAxis(const ir::Measure& measure) {
  if (!measure.setting) return false;
  const std::vector<ir::Axis> measured = measuredAxes(measure);
  return std::any_of(std::begin(ir::kAxes), std::end(ir::kAxes), [&](ir::Axis axis) {
    return measure.setting->nominal[ir::indexOf(axis)] != nullptr &&
           std::find(measured.begin(), measured.end(), axis) == measured.end();
  });
}

MacroCall macroCall(const stdlib::MacroSignature& signature, const ir::Measure& measure,
                    const CallValues& values) {
  return callOf(signature, measure, values);
}

MacroCall macroCall(const stdlib::MacroSignature& signature, const ir::Move& move, const CallValues& values) {
  return callOf(signature, move, values);
}

std::optional<ir::Axis> axisNotTaken(const stdlib::MacroSignature& signature, const ir::Move& move) {
  for (const ir::Axis axis : ir::kAxes)
    if (move.axes[ir::indexOf(axis)] && signature.find(stdlib::ArgumentRole::Target, axis) == nullptr)
      return axis;
  return std::nullopt;
}

std::string_view resultName(ir::ResultName name) {
  switch (name) {
  case ir::ResultName::Main: return "the result";
  case ir::ResultName::PositionX: return "the position in X";
  case ir::ResultName::PositionY: return "the position in Y";
  case ir::ResultName::PositionZ: return "the position in Z";
  case ir::ResultName::Size: return "the size";
  }
  return "";
}

const stdlib::MacroResult* findResult(const stdlib::MacroSignature& signature, ir::ResultName name) {
  const auto found = std::find_if(signature.results.begin(), signature.results.end(),
                                  [&](const stdlib::MacroResult& result) { return result.name == name; });
  return found == signature.results.end() ? nullptr : &*found;
}

FoundResult resultAfter(const stdlib::MacroSignature& signature, const ir::Measure& measure,
                        ir::ResultName name) {
  FoundResult out{findResult(signature, name), std::nullopt};
  if (out.result != nullptr || name != ir::ResultName::Main) return out;
  out.result = findResult(signature, ownResult(measure));
  if (out.result != nullptr) out.instead = ownResult(measure);
  return out;
}

} // namespace dotek::backends
