#include "ir/NumberSet.h"
#include "ir/SharedMap.h"
#include "lint/NcProgram.h"
#include "lint/Probing.h"

#include <algorithm>
#include <set>

namespace dotek::lint::rule {
namespace {

bool isScratch(const stdlib::MacroSet& set, std::uint32_t number) {
  for (const auto& [first, last] : set.scratch)
    if (number >= first && number <= last) return true;
  return false;
}

// Variables that the program set itself and that a macro may have overwritten since, with the call.
using Lost = ir::SharedMap<std::size_t>;
struct State {
  ir::NumberSet own;
  Lost lost;
};

bool isResult(const Project& project, std::uint32_t number) {
  for (const stdlib::MacroSet& set : project.macroSets)
    for (const stdlib::MacroSignature& signature : set.signatures)
      for (const stdlib::MacroResult& result : signature.results)
        if (result.variable == number) return true;
  return false;
}

void check(const NcProgram& nc, Report& report) {
  const ir::Program& program = nc.program;
  const Project& project = nc.project;
  const Probing& probing = probingOf(project);
  const auto setOf = [&](std::uint32_t number) -> const stdlib::MacroSet* {
    if (probing.isOwn(number)) return nullptr; // its text says what it writes
    for (const stdlib::MacroSet& set : project.macroSets)
      if (set.calls(number)) return &set;
    return nullptr;
  };
  const auto inScratch = [&](std::uint32_t number) {
    return std::any_of(project.macroSets.begin(), project.macroSets.end(),
                       [&](const stdlib::MacroSet& set) { return isScratch(set, number); });
  };
  const auto calls = [&](const ir::ProgramStatement& statement) {
    const std::uint32_t called = probing.step(statement).program;
    return called != 0 && setOf(called) != nullptr;
  };
  if (std::none_of(program.body.begin(), program.body.end(), calls)) return;
  const auto before = ir::factsBefore<State>(
      program.body, nc.flow(), State{},
      [&](std::size_t at, std::size_t, State state) {
        if (const auto number = storedNumber(program.body[at])) {
          state.lost.erase(*number);
          if (inScratch(*number) && !isResult(project, *number)) state.own.insert(*number);
        }
        const ProbeStep step = probing.step(program.body[at]);
        const stdlib::MacroSet* set = step.program == 0 ? nullptr : setOf(step.program);
        if (set == nullptr) return state;
        ir::NumberSet kept;
        state.own.each([&](std::uint32_t number) {
          if (!isScratch(*set, number))
            kept.insert(number);
          else if (state.lost.find(number) == nullptr)
            state.lost.set(number, at);
        });
        state.own = kept;
        return state;
      },
      [](State& into, const State& other) {
        const bool own = into.own.unite(other.own);
        return into.lost.unite(other.lost, [](std::size_t mine, std::size_t) { return mine; }) || own;
      });
  std::set<std::uint32_t> told;
  for (std::size_t i = 0; i < program.body.size(); ++i) {
    if (!before[i]) continue;
    for (const auto& [number, range] : nc.reads(i)) {
      const std::size_t* lost = before[i]->lost.find(number);
      if (lost == nullptr || !told.insert(number).second) continue;
      report
          .at(range,
              "#{} belongs to the variables that the probing macros work with, and one was called since the "
              "program set it; what is here is theirs; keep the value in another variable",
              number)
          .note(program.body[*lost].origin.range(), "the call");
    }
  }
}

} // namespace

DOTEK_LINT_RULE(overwritten_by_macro){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
