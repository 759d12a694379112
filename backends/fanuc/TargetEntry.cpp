#include "backends/fanuc/TargetEntry.h"

#include <cmath>

namespace dotek::targets {

void presetWear(const VerificationSource& from, const verify::Case& drawn, verify::Entry& entry) {
  constexpr double kWear = 0.125;
  const stdlib::SystemVariables& v = from.inputs.control->variables;
  if (!from.plan.cycleFile || !v.toolGeometry || !v.toolWear) return;
  for (const verify::DrawField& field : from.plan.fields) {
    const auto value = drawn.values.find(field.name);
    if (field.kind != ir::Kind::ToolOffset || value == drawn.values.end()) continue;
    const double tool = value->second;
    if (tool >= 1 && tool <= v.toolCount && tool == std::floor(tool))
      entry.variables.emplace_back(static_cast<std::uint32_t>(*v.toolWear) + static_cast<std::uint32_t>(tool),
                                   kWear);
  }
}

} // namespace dotek::targets
