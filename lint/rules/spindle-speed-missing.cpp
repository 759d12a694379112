#include "lint/NcProgram.h"

namespace dotek::lint::rule {
namespace {

void check(const NcProgram& nc, Report& report) {
  const auto& facts = nc.machining();
  for (std::size_t i = 0; i < facts.size(); ++i) {
    const auto* block = std::get_if<ir::NcBlock>(&nc.program.body[i].node);
    if (block == nullptr || !facts[i]) continue;
    const ir::Word* start = codeWord(*block, 'M', 3);
    if (start == nullptr) start = codeWord(*block, 'M', 4);
    if (start == nullptr) continue;
    const ir::Word* speed = firstWord(*block, "S");
    const double* value = speed == nullptr ? nullptr : ir::constantValue(speed->value);
    if (speed != nullptr && (value == nullptr || *value > 0)) continue;
    if (speed == nullptr && facts[i]->speed != Certain::No) continue;
    report.at(speed != nullptr ? speed->range : start->range,
              "the spindle is started and no speed above 0 was given; it stays, or turns as the program "
              "before left "
              "it; write S with the speed");
    return;
  }
}

} // namespace

DOTEK_LINT_RULE(spindle_speed_missing){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
