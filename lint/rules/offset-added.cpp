#include "lint/NcProgram.h"
#include "lint/Skips.h"

namespace dotek::lint::rule {
namespace {

// Under G91 G10 adds R, or X Y Z, to what the table holds (L2 and L20, L10 to L13).
void check(const NcProgram& nc, Report& report) {
  const auto& body = nc.program.body;
  const auto& modes = nc.modes();
  for (std::size_t i = 0; i < body.size(); ++i) {
    const auto* block = std::get_if<ir::NcBlock>(&body[i].node);
    if (block == nullptr || !modes[i] || *modes[i] != DistanceMode::Incremental || statedMode(body[i]))
      continue;
    if (!hasCode(*block, 'G', 10)) continue;
    const auto l = wordValue(*block, 'L');
    const bool tool = l && *l >= 10 && *l <= 13, system = l && (*l == 2 || *l == 20);
    if (!tool && !system) continue;
    report.at(
        body[i].origin.range(),
        "G91 of an earlier block is still in force, so this G10 adds to the {} offset instead of setting it; "
        "write G90 before, or G91 into the block where it is meant to add",
        tool ? "tool" : "work");
  }
}

} // namespace

DOTEK_LINT_RULE(offset_added){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
