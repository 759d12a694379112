#include "lint/NcProgram.h"

namespace dotek::lint::rule {
namespace {

void check(const NcProgram& nc, Report& report) {
  const auto& facts = nc.machining();
  bool changed = false;
  for (std::size_t i = 0; i < facts.size(); ++i) {
    const auto* block = std::get_if<ir::NcBlock>(&nc.program.body[i].node);
    if (block == nullptr || !facts[i]) continue;
    changed = changed || codeWord(*block, 'M', 6) != nullptr;
    const Machining now = within(*block, i, *facts[i]);
    if (!changed || axesOf(*block) == 0 || codeWord(*block, 'G', 53) != nullptr) continue;
    const int cycle = cycleOf(*block);
    const auto z = wordValue(*block, 'Z');
    // Before a tool touches it may have no length: it is measured.
    const bool below = now.distance == 0 ? z && *z < 0 : z && (now.distance == 90 ? *z <= 0 : *z < 0);
    if (now.probes || !(cycle != 0 || (below && isPlainMove(*block) && now.motion >= 1))) continue;
    const bool another = now.tool >= 0 && now.lengthOf >= 0 && now.tool != now.lengthOf;
    const bool other = now.length == Certain::Yes && another;
    // What was called before the tool change may have changed lengths, but for no tool that came later.
    const bool none = now.length == Certain::Unknown && now.taken == Certain::No && another;
    if (now.length != Certain::No && !other && !none) continue;
    const SourceRange range = nc.program.body[i].origin.range();
    if (other || none)
      report.at(
          range,
          "T{} is in the spindle, and the length in force is the one of T{}{}; the tool is too high, or "
          "goes into the part by the difference; write G43 with its H after the tool change",
          now.tool, now.lengthOf, none ? ", or what a called program left" : "");
    else
      report.at(range, "no tool length is in force at this move; Z counts from the nose of the spindle, and "
                       "the tool goes into the part by its length; write G43 with H after the tool change");
    return;
  }
}

} // namespace

DOTEK_LINT_RULE(length_offset_off){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
