#include "lint/NcProgram.h"
#include "lint/Probing.h"

#include <algorithm>

namespace dotek::lint::rule {
namespace {

bool statesFeed(const ir::Call& call) {
  return std::any_of(call.arguments.begin(), call.arguments.end(),
                     [](const ir::CallArgument& argument) { return argument.letter == 'F'; });
}

void checkProgram(const NcProgram& nc, const Probing& probing, Report& report) {
  const ir::Program& program = nc.program;
  const auto feeds = ir::factsBefore<bool>(
      program.body, nc.flow(), false,
      [&](std::size_t at, std::size_t, bool known) {
        const ir::ProgramStatement& statement = program.body[at];
        const ProbeStep::Kind kind = probing.step(statement).kind;
        if (kind == ProbeStep::Kind::Call || kind == ProbeStep::Kind::OwnCall ||
            kind == ProbeStep::Kind::PackCall)
          return true;
        const auto* call = std::get_if<ir::Call>(&statement.node);
        if (call != nullptr && kind == ProbeStep::Kind::Protected) return known || statesFeed(*call);
        const auto* block = std::get_if<ir::NcBlock>(&statement.node);
        return known || (block != nullptr && hasWord(*block, 'F'));
      },
      [](bool& into, bool other) {
        const bool changed = other && !into;
        into = into || other;
        return changed;
      });
  for (std::size_t i = 0; i < program.body.size(); ++i) {
    const auto* call = std::get_if<ir::Call>(&program.body[i].node);
    if (call == nullptr || probing.step(program.body[i]).kind != ProbeStep::Kind::Protected) continue;
    if (!feeds[i] || *feeds[i] || statesFeed(*call)) continue;
    report.at(program.body[i].origin.range(),
              "this is the first protected move of the program, and no feed was given "
              "yet; the macro takes one that was left over, or stops with its alarm "
              "88; write F");
    return;
  }
}

void check(const NcProgram& nc, Report& report) {
  if (endsProgram(nc.program)) checkProgram(nc, probingOf(nc.project), report);
}

} // namespace

DOTEK_LINT_RULE(first_protected_move_without_feed){
    .severity = Severity::Note,
    .byDefault = false,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
