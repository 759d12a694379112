#include "ir/NumberSet.h"
#include "lint/NcProgram.h"
#include "lint/Probing.h"

#include <set>

namespace dotek::lint::rule {
namespace {

constexpr std::uint32_t kMeasured = 0; // in the facts: a call that is known has measured

// What the signatures say that a call may be.
struct Reading {
  bool known = false; // each set that may be meant reads it in one way, and says what it leaves
  std::set<std::uint32_t> writes;
  std::set<std::uint32_t> ofSets; // results of all macros of those sets
  const stdlib::MacroSignature* signature = nullptr;
};

Reading readingOf(const ir::Call& call, std::uint32_t program, const Project& project) {
  std::string letters;
  for (const ir::CallArgument& argument : call.arguments)
    letters += argument.letter;
  Reading out;
  for (const stdlib::MacroSet& set : project.macroSets) {
    if (!set.calls(program) || !mayBeOf(set, program, letters)) continue;
    const stdlib::MacroSignature* const one = readKnown(set, program, letters).signature;
    if (one == nullptr || one->results.empty()) return {};
    out.known = true;
    out.signature = one;
    for (const stdlib::MacroResult& result : one->results)
      out.writes.insert(result.variable);
    for (const stdlib::MacroSignature& other : set.signatures)
      for (const stdlib::MacroResult& result : other.results)
        out.ofSets.insert(result.variable);
  }
  return out;
}

std::string resultsText(const stdlib::MacroSignature& signature) {
  std::string out;
  for (const stdlib::MacroResult& result : signature.results)
    out += fmt::format("{}#{} ({})", out.empty() ? "" : ", ", result.variable,
                       stdlib::outputName(result.output));
  return out;
}

void check(const NcProgram& nc, Report& report) {
  const Probing& probing = probingOf(nc.project);
  const auto& body = nc.program.body;
  std::vector<Reading> readings(body.size());
  std::set<std::uint32_t> results;
  for (std::size_t i = 0; i < body.size(); ++i) {
    const ProbeStep step = probing.step(body[i]);
    const ir::Call* call = callOf(body[i]);
    if (step.kind != ProbeStep::Kind::Measure || call == nullptr) continue;
    readings[i] = readingOf(*call, step.program, nc.project);
    results.insert(readings[i].ofSets.begin(), readings[i].ofSets.end());
  }
  if (results.empty()) return;
  ir::NumberSet all;
  for (const std::uint32_t number : results)
    all.insert(number);
  // Results that some path may have filled.
  const auto filled = ir::factsBefore<ir::NumberSet>(
      body, nc.flow(), {},
      [&](std::size_t at, std::size_t, ir::NumberSet set) {
        const ProbeStep::Kind kind = probing.step(body[at]).kind;
        if (readings[at].known) {
          set.insert(kMeasured);
          for (const std::uint32_t number : readings[at].writes)
            set.insert(number);
        } else if (kind == ProbeStep::Kind::Measure || kind == ProbeStep::Kind::PackCall ||
                   kind == ProbeStep::Kind::Call || kind == ProbeStep::Kind::OwnCall) {
          set.unite(all);
        }
        if (const auto number = storedNumber(body[at]); number && results.contains(*number))
          set.insert(*number);
        return set;
      },
      [](ir::NumberSet& into, const ir::NumberSet& other) { return into.unite(other); });
  std::set<std::uint32_t> told;
  const Reading* last = nullptr;
  for (std::size_t i = 0; i < body.size(); ++i) {
    if (filled[i] && filled[i]->contains(kMeasured) && last != nullptr)
      for (const auto& [number, range] : nc.reads(i)) {
        if (!last->ofSets.contains(number) || filled[i]->contains(number) || !told.insert(number).second)
          continue;
        report.at(range.hasPlace() ? range : body[i].origin.range(),
                  "no measurement before this sets #{}: P{} ({}) leaves {}; it holds what an earlier program "
                  "left, or nothing; read the variable that is meant",
                  number, last->signature->program, last->signature->title, resultsText(*last->signature));
      }
    if (readings[i].known) last = &readings[i];
  }
}

} // namespace

DOTEK_LINT_RULE(result_not_written){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
