#include "lint/Probing.h"

#include <map>
#include <set>

namespace dotek::lint::rule {
namespace {

bool isScratch(const stdlib::MacroSet& set, std::uint32_t number) {
  for (const auto& [first, last] : set.scratch)
    if (number >= first && number <= last) return true;
  return false;
}

// Variables that the program set itself and that a macro may have overwritten since, with the call.
using Lost = std::map<std::uint32_t, std::size_t>;
struct State {
  std::set<std::uint32_t> own;
  Lost lost;
};

void checkProgram(const ir::Program& program, const Project& project, const Probing& probing,
                  Report& report) {
  const auto setOf = [&](std::uint32_t number) -> const stdlib::MacroSet* {
    for (const stdlib::MacroSet& set : project.macroSets)
      if (set.calls(number)) return &set;
    return nullptr;
  };
  std::set<std::uint32_t> results;
  for (const stdlib::MacroSet& set : project.macroSets)
    for (const stdlib::MacroSignature& signature : set.signatures)
      for (const stdlib::MacroResult& result : signature.results)
        results.insert(result.variable);
  const auto before = ir::factsBefore<State>(
      program.body, State{},
      [&](std::size_t at, std::size_t, State state) {
        if (const auto number = storedNumber(program.body[at])) {
          state.lost.erase(*number);
          if (!results.contains(*number)) state.own.insert(*number);
        }
        const ProbeStep step = probing.step(program.body[at]);
        const stdlib::MacroSet* set = step.program == 0 ? nullptr : setOf(step.program);
        if (set == nullptr) return state;
        for (auto own = state.own.begin(); own != state.own.end();) {
          if (isScratch(*set, *own)) {
            state.lost.try_emplace(*own, at);
            own = state.own.erase(own);
          } else {
            ++own;
          }
        }
        return state;
      },
      [](State& into, const State& other) {
        const std::size_t size = into.own.size() + into.lost.size();
        into.own.insert(other.own.begin(), other.own.end());
        into.lost.insert(other.lost.begin(), other.lost.end());
        return into.own.size() + into.lost.size() != size;
      });
  std::set<std::uint32_t> told;
  for (std::size_t i = 0; i < program.body.size(); ++i) {
    if (!before[i]) continue;
    eachRead(program.body[i], [&](std::uint32_t number, SourceRange range) {
      const auto lost = before[i]->lost.find(number);
      if (lost == before[i]->lost.end() || !told.insert(number).second) return;
      report
          .at(range,
              "#{} belongs to the variables that the probing macros work with, and one was called since the "
              "program set it; what is here is theirs; keep the value in another variable",
              number)
          .note(program.body[lost->second].origin.range(), "the call");
    });
  }
}

void check(const Project& project, Report& report) {
  const Probing& probing = probingOf(project);
  eachProgram(project, [&](const ir::Program& program, const macrob::File&) {
    checkProgram(program, project, probing, report);
  });
}

} // namespace

DOTEK_LINT_RULE(overwritten_by_macro){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .check = check,
};

} // namespace dotek::lint::rule
