#include "targets/ToolEntry.h"

#include "targets/Subject.h"

#include <algorithm>
#include <cmath>

namespace dotek::targets {

std::vector<ToolEntry> toolEntries(const VerifyPlan& plan, const verify::Case& drawn) {
  constexpr double kMost = 999, kStep = 0.25;
  std::vector<ToolEntry> out;
  for (const verify::DrawField& field : plan.fields) {
    const auto value = drawn.values.find(field.name);
    if (field.kind != ir::Kind::ToolOffset || value == drawn.values.end()) continue;
    const double tool = value->second;
    if (!(tool >= 1 && tool <= kMost) || tool != std::floor(tool)) continue;
    ToolEntry entry;
    entry.number = static_cast<std::uint32_t>(tool);
    entry.radius += kStep * tool;
    const auto same = [&](const ToolEntry& other) { return other.number == entry.number; };
    if (std::none_of(out.begin(), out.end(), same)) out.push_back(entry);
  }
  return out;
}

} // namespace dotek::targets
