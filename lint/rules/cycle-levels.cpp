#include "lint/NcProgram.h"

namespace dotek::lint::rule {
namespace {

void check(const NcProgram& nc, Report& report) {
  const auto& facts = nc.machining();
  for (std::size_t i = 0; i < facts.size(); ++i) {
    const auto* block = std::get_if<ir::NcBlock>(&nc.program.body[i].node);
    if (block == nullptr || !facts[i]) continue;
    const int cycle = cycleOf(*block);
    if (cycle == 0 || cycle == 87 || within(*block, i, *facts[i]).distance != 90) continue;
    const auto depth = wordValue(*block, 'Z');
    const auto level = wordValue(*block, 'R');
    if (!depth || !level || *level > *depth) continue;
    report.at(firstWord(*block, "R")->range,
              "R{} is not above the depth Z{}; the tool goes at rapid to R and drills nothing, or into the "
              "part; the "
              "values are swapped, or a sign is missing",
              *level, *depth);
  }
}

} // namespace

DOTEK_LINT_RULE(cycle_levels){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
