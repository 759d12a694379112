#include "lint/NcProgram.h"
#include "lint/Skips.h"

namespace dotek::lint::rule {
namespace {

void check(const NcProgram& nc, Report& report) {
  const ir::Program& program = nc.program;
  const auto& modes = nc.modes();
  const stdlib::Control* const control = nc.project.control;
  if (control != nullptr && control->functions.contains("incremental_machine_moves")) return;
  for (std::size_t i = 0; i < program.body.size(); ++i) {
    const ir::ProgramStatement& statement = program.body[i];
    const auto* block = std::get_if<ir::NcBlock>(&statement.node);
    if (block == nullptr || !modes[i] || !hasCode(*block, 'G', 53) || hasCode(*block, 'G', 31) ||
        axesOf(*block) == 0)
      continue;
    if (statedMode(statement).value_or(*modes[i]) != DistanceMode::Incremental) continue;
    report.at(statement.origin.range(), "G53 takes absolute coordinates alone, and G91 holds here; the "
                                        "control ignores the block, and the next "
                                        "move starts from where the axes are; write G90 into it");
  }
}

} // namespace

DOTEK_LINT_RULE(machine_move_incremental){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
