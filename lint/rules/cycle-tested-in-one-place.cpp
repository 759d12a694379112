#include "lint/ProgBlocks.h"

#include <algorithm>
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
    std::set<std::string> told;
    for (const auto& [one, with] : routines) {
      for (const auto& [other, without] : routines) {
        if (one == other) continue;
        const auto shared = static_cast<std::size_t>(
            std::count_if(with.begin(), with.end(),
                          [&, &w = without](const auto& test) { return w.contains(test.first); }));
        // The two keep the same list when all but one of its cycles are in both.
        if (shared < 2 || shared + 1 != with.size() || without.size() != shared) continue;
        for (const auto& [id, range] : with) {
          if (without.contains(id) || !told.insert(id).second) continue;
          report
              .at(range,
                  "the cycle `{}` is told apart here and not in the routine `{}`, which knows the {} others; "
                  "the post treats it as no cycle there; add it",
                  id, other->name, shared)
              .note(other->nameRange, "this routine does not test it");
        }
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
