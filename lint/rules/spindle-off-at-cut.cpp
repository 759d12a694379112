#include "lint/NcProgram.h"

namespace dotek::lint::rule {
namespace {

// Tapping turns the spindle by itself where it is rigid.
bool taps(int cycle) {
  return cycle == 74 || cycle == 84;
}

void check(const NcProgram& nc, Report& report) {
  const auto& facts = nc.machining();
  for (std::size_t i = 0; i < facts.size(); ++i) {
    const auto* block = std::get_if<ir::NcBlock>(&nc.program.body[i].node);
    if (block == nullptr || !facts[i] || facts[i]->spindle != Certain::No || facts[i]->probes) continue;
    if (codeWord(*block, 'M', 3) != nullptr || codeWord(*block, 'M', 4) != nullptr ||
        codeWord(*block, 'M', 13) != nullptr)
      continue;
    const Machining now = within(*block, i, *facts[i]);
    const int cycle = cycleOf(*block);
    const bool drills = cycle != 0 && !taps(cycle) && axesOf(*block) != 0;
    const bool arc = isPlainMove(*block) == false && now.motion >= 2 && axesOf(*block) != 0 &&
                     (codeWord(*block, 'G', 2) != nullptr || codeWord(*block, 'G', 3) != nullptr);
    const bool feeds =
        isPlainMove(*block) && now.motion >= 1 && now.mode(Mode::CannedCycle).on == Certain::No;
    // The first move down at feed, or what follows it: positioning at feed above the part is no cut.
    const auto z = wordValue(*block, 'Z');
    const bool down = z && *z < 0 && now.distance == 90 && now.z && *z < *now.z;
    if (!drills && !arc && !(feeds && (down || (now.lowered && axesOf(*block) != 0 && !z)))) continue;
    report.at(nc.program.body[i].origin.range(),
              "the spindle does not turn here: no M3 or M4 is on the path since {}; the tool is pushed into "
              "the part "
              "and breaks; write S and M3 before",
              facts[i]->tool >= 0 ? "the tool change" : "the start, or an M5 stopped it");
    return;
  }
}

} // namespace

DOTEK_LINT_RULE(spindle_off_at_cut){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
