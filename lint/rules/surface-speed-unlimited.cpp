#include "lint/NcProgram.h"
#include "lint/Turning.h"

namespace dotek::lint::rule {
namespace {

using stdlib::Function;

// In the order of the text: what is limited anywhere before counts, and what a called program may limit.
void check(const NcProgram& nc, Report& report) {
  if (!isForLathe(nc.project)) return;
  const stdlib::Control& control = *nc.project.control;
  bool ends = false;
  for (const ir::ProgramStatement& statement : nc.program.body)
    if (const auto* block = std::get_if<ir::NcBlock>(&statement.node))
      ends = ends || codeWord(*block, 'M', 30) != nullptr || codeWord(*block, 'M', 2) != nullptr;
  if (!ends) return; // its caller may have set a limit
  for (const ir::ProgramStatement& statement : nc.program.body) {
    if (callOf(statement) != nullptr) return;
    const auto* block = std::get_if<ir::NcBlock>(&statement.node);
    if (block == nullptr) continue;
    if (wordOf(*block, control, Function::SetPosition) != nullptr && firstWord(*block, "S") != nullptr)
      return;
    const ir::Word* on = wordOf(*block, control, Function::SurfaceSpeedOn);
    if (on == nullptr) continue;
    report.at(
        on->range,
        "constant surface speed, and no block before it limits the speed of the spindle; towards the "
        "centre the spindle goes up to its highest speed, whatever the chuck bears; write `G50 S` with a "
        "speed before it");
    return;
  }
}

} // namespace

DOTEK_LINT_RULE(surface_speed_unlimited){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
