#include "ir/Dataflow.h"
#include "lint/NcProgram.h"
#include "lint/Skips.h"

#include <algorithm>

namespace dotek::lint::rule {
namespace {

void check(const NcProgram& nc, Report& report) {
  const ir::Program& program = nc.program;
  const auto& body = program.body;
  const auto hasNoFeed = [&](std::size_t at) {
    const ir::NcBlock& skip = *skipOf(body[at]);
    return !hasWord(skip, 'F') && axesOf(skip) != 0;
  };
  if (std::none_of(nc.skips().begin(), nc.skips().end(), hasNoFeed)) return;
  const ir::ProgramStatement* withFeed = nullptr;
  for (const std::size_t at : nc.skips())
    if (hasWord(*skipOf(body[at]), 'F') && withFeed == nullptr) withFeed = &body[at];
  const auto given = ir::factsBefore<bool>(
      body, nc.flow(), false,
      [&](std::size_t at, std::size_t, bool before) {
        const auto* block = std::get_if<ir::NcBlock>(&body[at].node);
        return before || (block != nullptr && hasWord(*block, 'F')) || callOf(body[at]) != nullptr;
      },
      [](bool& into, bool other) {
        const bool changed = other && !into;
        into = into || other;
        return changed;
      });
  for (const std::size_t i : nc.skips()) {
    if (!hasNoFeed(i) || !given[i]) continue;
    if (!*given[i] && endsProgram(program))
      report.at(
          body[i].origin.range(),
          "no feed was given before this G31; the control stops with an alarm, or moves at the feed of the "
          "program before; write F into the block");
    else if (withFeed != nullptr)
      report
          .at(body[i].origin.range(),
              "this G31 has no feed of its own and goes at the one in force, which a move may have set; the "
              "place of the contact depends on the feed; write F into the block")
          .note(withFeed->origin.range(), "another G31 has one");
  }
}

} // namespace

DOTEK_LINT_RULE(skip_without_feed){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
