#include "stdlib/MacroCycle.h"

#include <algorithm>
#include <utility>

namespace dotek::stdlib {
namespace {

constexpr std::array<bool, 3> kPlane = {true, true, false};
constexpr std::array<bool, 3> kAll = {true, true, true};

bool hasAxis(ArgumentRole role) {
  switch (role) {
  case ArgumentRole::Target:
  case ArgumentRole::Nominal:
  case ArgumentRole::Width:
  case ArgumentRole::Spacing:
  case ArgumentRole::Point: return true;
  default: return false;
  }
}

std::array<bool, 3> along(std::optional<ir::Axis> axis) {
  std::array<bool, 3> out{};
  if (!axis) return kAll;
  out[ir::indexOf(*axis)] = true;
  return out;
}

} // namespace

CycleFacts cycleFacts(const MacroSignature& signature) {
  CycleFacts out;
  switch (signature.intent) {
  case Intent::ProtectedMove: out.returns = false; break;
  case Intent::Surface:
  case Intent::Pocket:
  case Intent::Web:
  case Intent::Angle: out.sets = along(axisOf(signature)); break;
  case Intent::Bore:
  case Intent::Boss:
  case Intent::AngledSurface:
  case Intent::AngledPocket:
  case Intent::AngledWeb:
  case Intent::ThreePointBore:
  case Intent::ThreePointBoss:
  case Intent::InnerCorner:
  case Intent::OuterCorner: out.sets = kPlane; break;
  case Intent::StockAllowance:
    out.sets = along(axisOf(signature));
    out.returns = false;
    break;
  case Intent::BoltCircle:
    out.sets = kPlane;
    out.returns = false;
    break;
  case Intent::Calibration:
    out.sets = kAll;
    out.returns = false;
    break;
  case Intent::FeatureToFeature:
  case Intent::ToolUpdate:
    out.sets = kAll;
    out.moves = false;
    break;
  case Intent::ProbeOn:
  case Intent::ProbeOff:
    out.moves = false;
    out.power = signature.intent == Intent::ProbeOn;
    break;
  }
  if (out.moves && !signature.unknown.empty()) out.returns = false;
  return out;
}

std::optional<ir::Axis> axisOf(const MacroSignature& signature) {
  switch (signature.intent) {
  case Intent::Surface:
  case Intent::Pocket:
  case Intent::Web:
  case Intent::Angle:
  case Intent::StockAllowance: break;
  default: return std::nullopt;
  }
  const auto found =
      std::find_if(signature.arguments.begin(), signature.arguments.end(), [](const MacroArgument& argument) {
        return argument.role == ArgumentRole::Target || argument.role == ArgumentRole::Width;
      });
  return found == signature.arguments.end() ? std::nullopt : std::optional(found->axis);
}

std::string languageName(std::string_view name) {
  std::string out(name);
  std::replace(out.begin(), out.end(), '-', '_');
  return out;
}

namespace {

std::string measures(Intent intent, std::optional<ir::Axis> axis) {
  std::string out = "measure_" + languageName(intentName(intent));
  if (axis) out += std::string("_") + "xyz"[ir::indexOf(*axis)];
  return out;
}

} // namespace

std::string libraryCycle(const MacroSignature& signature) {
  return measures(signature.intent, axisOf(signature));
}

std::string islandCycle(const MacroSignature& signature) {
  constexpr std::pair<Intent, Intent> kInside[] = {{Intent::Boss, Intent::Bore},
                                                   {Intent::Web, Intent::Pocket},
                                                   {Intent::AngledWeb, Intent::AngledPocket},
                                                   {Intent::ThreePointBoss, Intent::ThreePointBore}};
  for (const auto& [outside, inside] : kInside)
    if (signature.intent == outside) return measures(inside, axisOf(signature)) + "_island";
  return "";
}

std::string parameterName(const MacroArgument& argument) {
  if (argument.role == ArgumentRole::Unstated)
    return std::string("letter ") + static_cast<char>(argument.letter - 'A' + 'a');
  std::string out(roleName(argument.role));
  if (hasAxis(argument.role)) out += std::string(" ") + "xyz"[ir::indexOf(argument.axis)];
  return out;
}

std::string parameterWords(std::string_view parameter) {
  if (parameter == roleName(ArgumentRole::FlagOnly)) return "M1, which raises no alarm";
  return "its " + std::string(parameter);
}

bool isPrintout(std::string_view parameter) {
  return parameter == roleName(ArgumentRole::Print);
}

bool movesProbe(ArgumentRole role) {
  switch (role) {
  case ArgumentRole::Nominal:
  case ArgumentRole::System:
  case ArgumentRole::Tool:
  case ArgumentRole::SpareTool:
  case ArgumentRole::Experience:
  case ArgumentRole::SizeTolerance:
  case ArgumentRole::PositionTolerance:
  case ArgumentRole::AngleTolerance:
  case ArgumentRole::UpperLimit:
  case ArgumentRole::NullBand:
  case ArgumentRole::Feedback:
  case ArgumentRole::Print: return false;
  case ArgumentRole::Target:
  case ArgumentRole::Feed:
  case ArgumentRole::Diameter:
  case ArgumentRole::Width:
  case ArgumentRole::Depth:
  case ArgumentRole::Clearance:
  case ArgumentRole::Overtravel:
  case ArgumentRole::FlagOnly:
  case ArgumentRole::Spacing:
  case ArgumentRole::FaceAngle:
  case ArgumentRole::Direction:
  case ArgumentRole::Distance:
  case ArgumentRole::FirstAngle:
  case ArgumentRole::SecondAngle:
  case ArgumentRole::ThirdAngle:
  case ArgumentRole::PitchDiameter:
  case ArgumentRole::StartAngle:
  case ArgumentRole::Number:
  case ArgumentRole::Point:
  case ArgumentRole::Task:
  case ArgumentRole::Unstated: break;
  }
  return true;
}

} // namespace dotek::stdlib
