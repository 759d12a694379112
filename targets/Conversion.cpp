#include "targets/Conversion.h"

#include "project/Values.h"

namespace dotek::targets {

std::optional<LoweredSource> lowerSource(const CycleFolder& folder, ConversionContext& context) {
  Session& session = context.session;
  std::optional<LoweredCycle> lowered = context.compilation.lower(folder);
  if (!lowered) return std::nullopt;
  LoweredSource out{std::move(*lowered), {}};
  ir::Cycle& cycle = out.lowered.cycle;
  cycle.name = folder.name;
  applyDefaults(context.options.defaults, out.lowered, context.usedDefaults, session);
  for (ir::VariableId id = 0; id < cycle.variables.size(); ++id)
    if (const auto value = cycle.variable(id).defaultValue) out.defaults.emplace(id, *value);
  settleValues(folder, out.lowered, session);
  return out;
}

} // namespace dotek::targets
