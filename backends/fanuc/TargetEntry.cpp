#include "backends/fanuc/TargetEntry.h"

#include "stdlib/RadiusOffsets.h"
#include "targets/ToolEntry.h"

namespace dotek::targets {

void presetTools(const VerificationSource& from, const verify::Case& drawn, verify::Entry& entry) {
  const stdlib::SystemVariables& v = from.inputs.control->variables;
  if (!from.plan.cycleFile) return;
  const stdlib::RadiusOffsets radii = stdlib::radiusOffsets(*from.inputs.control);
  for (const ToolEntry& tool : toolEntries(from.plan, drawn)) {
    if (tool.number > static_cast<std::uint32_t>(v.toolCount)) continue;
    const auto put = [&](const std::optional<int>& base, double value) {
      if (base) entry.variables.emplace_back(static_cast<std::uint32_t>(*base) + tool.number, value);
    };
    if (v.toolGeometry) put(v.toolWear, tool.lengthWear);
    put(radii.geometry, tool.radius);
    put(radii.wear, tool.radiusWear);
  }
}

} // namespace dotek::targets
