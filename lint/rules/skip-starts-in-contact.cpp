#include "ir/Dataflow.h"
#include "lint/NcProgram.h"
#include "lint/Skips.h"

namespace dotek::lint::rule {
namespace {

// What happened since the last move away: nothing, a skip move, and its contact was read.
enum class Contact : std::uint8_t { Free, Skipped, Used };

void check(const NcProgram& nc, Report& report) {
  const ir::Program& program = nc.program;
  const auto& body = program.body;
  const auto states = ir::factsBefore<Contact>(
      body, nc.flow(), Contact::Free,
      [&](std::size_t at, std::size_t, Contact state) {
        if (skipOf(body[at]) != nullptr) return Contact::Skipped;
        if (callOf(body[at]) != nullptr) return Contact::Free;
        if (const auto* block = std::get_if<ir::NcBlock>(&body[at].node))
          if (axesOf(*block) != 0) return Contact::Free;
        if (state != Contact::Skipped) return state;
        eachRead(body[at], [&](std::uint32_t number, SourceRange) {
          if (contactAxis(number) && std::holds_alternative<ir::Store>(body[at].node)) state = Contact::Used;
        });
        return state;
      },
      [](Contact& into, Contact other) {
        // A path on which the stylus is free is one on which all is well.
        if (into == other || into == Contact::Free) return false;
        const Contact merged = other == Contact::Used ? into : other;
        const bool changed = merged != into;
        into = merged;
        return changed;
      });
  for (std::size_t i = 0; i < body.size(); ++i) {
    if (skipOf(body[i]) == nullptr || !states[i] || *states[i] != Contact::Used) continue;
    report.at(
        body[i].origin.range(),
        "the G31 before this one stopped at a surface, and nothing takes the stylus away from it; this one "
        "begins in contact and stops at once, or with an alarm; go back with G1 first");
  }
}

} // namespace

DOTEK_LINT_RULE(skip_starts_in_contact){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
