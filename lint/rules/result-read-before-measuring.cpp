#include "ir/NumberSet.h"
#include "lint/NcProgram.h"
#include "lint/Probing.h"

#include <set>

namespace dotek::lint::rule {
namespace {

std::set<std::uint32_t> resultsOf(const Project& project, const ir::Program& program,
                                  const Probing& probing) {
  std::set<std::uint32_t> out;
  for (const ir::ProgramStatement& statement : program.body) {
    const ProbeStep step = probing.step(statement);
    if (step.kind != ProbeStep::Kind::Measure) continue;
    for (const stdlib::MacroSet& set : project.macroSets)
      for (const stdlib::MacroSignature* signature : set.of(step.program))
        for (const stdlib::MacroResult& result : signature->results)
          out.insert(result.variable);
  }
  return out;
}

void checkProgram(const NcProgram& nc, const Project& project, const Probing& probing, Report& report) {
  const ir::Program& program = nc.program;
  const std::set<std::uint32_t> results = resultsOf(project, program, probing);
  if (results.empty()) return;
  ir::NumberSet all;
  for (const std::uint32_t result : results)
    all.insert(result);
  // Results that some path may have filled.
  const auto filled = ir::factsBefore<ir::NumberSet>(
      program.body, nc.flow(), {},
      [&](std::size_t at, std::size_t, ir::NumberSet set) {
        const ProbeStep::Kind kind = probing.step(program.body[at]).kind;
        if (kind == ProbeStep::Kind::Measure || kind == ProbeStep::Kind::PackCall ||
            kind == ProbeStep::Kind::Call || kind == ProbeStep::Kind::OwnCall)
          set.unite(all);
        const auto number = storedNumber(program.body[at]);
        if (number && results.contains(*number)) set.insert(*number);
        return set;
      },
      [](ir::NumberSet& into, const ir::NumberSet& other) { return into.unite(other); });
  std::set<std::uint32_t> told;
  for (std::size_t i = 0; i < program.body.size(); ++i) {
    if (!filled[i]) continue;
    for (const auto& [number, range] : nc.reads(i)) {
      if (!results.contains(number) || filled[i]->contains(number) || !told.insert(number).second) continue;
      report.at(range,
                "#{} is read before the first measurement of this program; it holds what the last program "
                "left, or nothing; an offset that is set from it moves the part's zero anywhere; measure "
                "first",
                number);
    }
  }
}

void check(const NcProgram& nc, Report& report) {
  checkProgram(nc, nc.project, probingOf(nc.project), report);
}

} // namespace

DOTEK_LINT_RULE(result_read_before_measuring){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
