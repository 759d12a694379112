#include "sim/machine/Measurement.h"

#include "sim/machine/Value.h"

namespace dotek::sim {
namespace {

using stdlib::ArgumentRole;
using stdlib::Intent;
using stdlib::Output;

std::string sizeName(Intent intent) {
  switch (intent) {
  case Intent::Bore:
  case Intent::Boss:
  case Intent::ThreePointBore:
  case Intent::ThreePointBoss:
  case Intent::BoltCircle: return "diameter";
  default: return "width";
  }
}

} // namespace

Measurement measurementOf(const stdlib::MacroSignature& signature, std::span<const double> locals,
                          const std::map<Output, double>& found) {
  Measurement out;
  out.program = signature.program;
  out.title = signature.title;
  const auto get = [&](Output output) {
    const auto at = found.find(output);
    return at == found.end() || isNull(at->second) || isUnknown(at->second) ? std::nullopt
                                                                            : std::optional(at->second);
  };
  const auto argument = [&](ArgumentRole role, ir::Axis axis) -> std::optional<double> {
    const stdlib::MacroArgument* const one = signature.find(role, axis);
    const std::uint32_t local = one == nullptr ? 0 : stdlib::localOf(one->letter);
    if (local == 0 || local >= locals.size() || isNull(locals[local])) return std::nullopt;
    return locals[local];
  };
  const auto add = [&](std::string name, Output measured, Output error, std::optional<double> nominal) {
    const std::optional<double> value = get(measured), off = get(error);
    if (!value) return;
    if (!nominal && off) nominal = *value - *off;
    const bool angle = measured == Output::Angle;
    out.values.push_back({std::move(name), nominal, *value, angle ? ir::Kind::Angle : ir::Kind::Length});
  };
  add("X", Output::PositionX, Output::ErrorX, argument(ArgumentRole::Nominal, ir::Axis::X));
  add("Y", Output::PositionY, Output::ErrorY, argument(ArgumentRole::Nominal, ir::Axis::Y));
  add("Z", Output::PositionZ, Output::ErrorZ, argument(ArgumentRole::Nominal, ir::Axis::Z));
  add(sizeName(signature.intent), Output::Size, Output::SizeError, std::nullopt);
  add("angle", Output::Angle, Output::AngleError, std::nullopt);
  return out;
}

} // namespace dotek::sim
