#include "lint/ProgBlocks.h"

#include <algorithm>
#include <functional>
#include <map>
#include <set>

namespace dotek::lint::rule {
namespace {

// Cycles that a routine tells apart, with the place of the first test of each.
using Tests = std::map<std::string, SourceRange>;

void collect(const compost::Condition& condition, Tests& tests) {
  for (const compost::ConditionTerm& term : condition.terms) {
    if (const std::string* id = compost::cycleTested(term)) tests.try_emplace(*id, term.range);
    if (const auto* inner = std::get_if<std::unique_ptr<compost::Condition>>(&term.operand))
      collect(**inner, tests);
  }
}

void check(const Project& project, Report& report) {
  for (const compost::Program* prog : project.progs) {
    std::vector<std::pair<const compost::Routine*, Tests>> routines;
    for (const compost::Item& item : prog->items) {
      const auto* routine = std::get_if<compost::Routine>(&item);
      if (routine == nullptr) continue;
      Tests tests;
      eachStatement(routine->body, [&](const compost::Statement& statement) {
        if (const auto* branch = std::get_if<std::unique_ptr<compost::If>>(&statement))
          collect((*branch)->condition, tests);
      });
      if (tests.size() >= 2) routines.emplace_back(routine, std::move(tests));
    }
    // Routines by the sum of the hashes of their cycles: one without a cycle is found by taking its hash off.
    std::map<std::size_t, std::vector<const std::pair<const compost::Routine*, Tests>*>> bySum;
    const std::hash<std::string> hash;
    const auto sumOf = [&](const Tests& tests) {
      std::size_t sum = 0;
      for (const auto& [id, range] : tests)
        sum += hash(id);
      return sum;
    };
    for (const auto& routine : routines)
      bySum[sumOf(routine.second)].push_back(&routine);
    std::set<std::string> told;
    for (const auto& one : routines) { // clang 14 captures no structured bindings
      const Tests& with = one.second;
      if (with.size() < 3) continue;
      const std::size_t sum = sumOf(with);
      for (const auto& test : with) {
        const std::string& id = test.first;
        const auto others = bySum.find(sum - hash(id));
        if (others == bySum.end() || told.contains(id)) continue;
        // The two keep the same list when all but one of its cycles are in both.
        const auto other =
            std::find_if(others->second.begin(), others->second.end(), [&](const auto* routine) {
              const Tests& without = routine->second;
              return without.size() + 1 == with.size() && !without.contains(id) &&
                     std::all_of(without.begin(), without.end(),
                                 [&](const auto& kept) { return with.contains(kept.first); });
            });
        if (other == others->second.end()) continue;
        told.insert(id);
        report
            .at(test.second,
                "the cycle `{}` is tested here and not in the routine `{}`, which tests the {} others; "
                "the post treats it as no cycle there; add it",
                id, (*other)->first->name, with.size() - 1)
            .note((*other)->first->nameRange, "this routine does not test it");
      }
    }
  }
}

} // namespace

DOTEK_LINT_RULE(cycle_tested_in_one_place){
    .severity = Severity::Warning,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
