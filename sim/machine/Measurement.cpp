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
  const auto valueOf = [&](const stdlib::MacroArgument& one) -> std::optional<double> {
    const std::uint32_t local = stdlib::localOf(one.letter);
    if (local == 0 || local >= locals.size() || isNull(locals[local])) return std::nullopt;
    return locals[local];
  };
  // Where the call says that the surface is expected, or what coordinate it gets.
  const auto placeOf = [&](ir::Axis axis) -> std::optional<double> {
    if (const auto* nominal = signature.find(ArgumentRole::Nominal, axis))
      if (const auto value = valueOf(*nominal)) return value;
    const auto* const target = signature.find(ArgumentRole::Target, axis);
    return target != nullptr && target->frame == ir::Frame::Work ? valueOf(*target) : std::nullopt;
  };
  const auto expectedSize = [&]() -> std::optional<double> {
    for (const stdlib::MacroArgument& one : signature.arguments)
      if (one.role == ArgumentRole::Diameter || one.role == ArgumentRole::Width)
        if (const auto value = valueOf(one)) return value;
    return std::nullopt;
  };
  const auto add = [&](std::string name, Output measured, Output error, std::optional<double> nominal) {
    const std::optional<double> value = get(measured), off = get(error);
    if (!value) return;
    if (!nominal && off) nominal = *value - *off;
    const bool angle = measured == Output::Angle;
    out.values.push_back({std::move(name), nominal, *value, angle ? ir::Kind::Angle : ir::Kind::Length});
  };
  add("X", Output::PositionX, Output::ErrorX, placeOf(ir::Axis::X));
  add("Y", Output::PositionY, Output::ErrorY, placeOf(ir::Axis::Y));
  add("Z", Output::PositionZ, Output::ErrorZ, placeOf(ir::Axis::Z));
  add(sizeName(signature.intent), Output::Size, Output::SizeError, expectedSize());
  add("angle", Output::Angle, Output::AngleError, std::nullopt);
  return out;
}

} // namespace dotek::sim
