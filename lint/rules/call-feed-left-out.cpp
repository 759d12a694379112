#include "lint/NcProgram.h"
#include "lint/Probing.h"

namespace dotek::lint::rule {
namespace {

constexpr std::size_t kTimes = 6; // so many times as many have one

void check(const NcProgram& nc, Report& report) {
  const ir::Program& program = nc.program;
  const Probing& probing = probingOf(nc.project);
  std::vector<const ir::ProgramStatement*> with, without;
  for (const ir::ProgramStatement& statement : program.body) {
    const auto* call = std::get_if<ir::Call>(&statement.node);
    if (call == nullptr || probing.step(statement).kind != ProbeStep::Kind::Protected) continue;
    bool feed = false;
    for (const ir::CallArgument& argument : call->arguments)
      feed = feed || argument.letter == 'F';
    (feed ? with : without).push_back(&statement);
  }
  if (without.empty() || with.size() < kTimes * without.size()) return;
  for (const ir::ProgramStatement* statement : without)
    report
        .at(statement->origin.range(), "this protected move has no F and goes at the feed of the one "
                                       "before, on the path down maybe at that "
                                       "of a travel; the other ones of the program state theirs; write F")
        .note(with.front()->origin.range(), "as here");
}

} // namespace

DOTEK_LINT_RULE(call_feed_left_out){
    .severity = Severity::Note,
    .byDefault = false,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
