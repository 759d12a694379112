#include "ir/Dataflow.h"
#include "lint/NcProgram.h"

namespace dotek::lint::rule {
namespace {

// 0: the control reads ahead, or it is not known; else one more than the place of the G103 that limits it.
using Limited = std::size_t;

void check(const NcProgram& nc, Report& report) {
  const auto& body = nc.program.body;
  const auto limitOf = [&](std::size_t at) -> std::optional<bool> {
    const auto* block = std::get_if<ir::NcBlock>(&body[at].node);
    if (block == nullptr || !hasCode(*block, 'G', 103)) return std::nullopt;
    return wordValue(*block, 'P').value_or(0) >= 1;
  };
  bool any = false;
  for (std::size_t i = 0; i < body.size() && !any; ++i)
    any = limitOf(i) == true;
  if (!any || !endsProgram(nc.program)) return;
  const auto states = ir::factsBefore<Limited>(
      body, nc.flow(), Limited{0},
      [&](std::size_t at, std::size_t, Limited limited) -> Limited {
        if (const auto limits = limitOf(at)) return *limits ? at + 1 : 0;
        return callOf(body[at]) != nullptr && nc.project.control == nullptr ? 0 : limited;
      },
      [](Limited& into, Limited other) {
        if (into == other || into == 0) return false;
        if (other == 0) into = 0;
        return other == 0;
      });
  for (std::size_t i = 0; i < body.size(); ++i) {
    if (!ir::endsProgram(body[i]) || !states[i] || *states[i] == 0) continue;
    report
        .at(body[*states[i] - 1].origin.range(), "G103 limits how far the control reads ahead, and nothing "
                                                 "ends that before the program does; what "
                                                 "is milled next goes block by block and leaves marks; write "
                                                 "G103 by itself where the last position "
                                                 "has been read")
        .note(body[i].origin.range(), "the program ends here");
    return;
  }
}

} // namespace

DOTEK_LINT_RULE(read_ahead_left_limited){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
