#include "lint/ProgBlocks.h"

#include <algorithm>
#include <set>

namespace dotek::lint::rule {
namespace {

using Ids = std::set<std::string>;

void walk(const std::vector<compost::Statement>& statements, const std::optional<Ids>& possible,
          Report& report) {
  for (const compost::Statement& statement : statements) {
    const auto* branch = std::get_if<std::unique_ptr<compost::If>>(&statement);
    if (branch == nullptr) continue;
    const compost::If& choice = **branch;
    const std::optional<Ids> ids = compost::cyclesOf(choice.condition);
    std::optional<Ids> inner = possible;
    if (ids && possible) {
      Ids both;
      std::set_intersection(ids->begin(), ids->end(), possible->begin(), possible->end(),
                            std::inserter(both, both.begin()));
      if (both.empty()) {
        report.at(choice.condition.range,
                  "this branch is inside one for `{}`, where the cycle is never `{}`; nothing of it "
                  "is printed; an END before it is missing, or a name is a misprint",
                  *possible->begin(), *ids->begin());
        walk(choice.elseBody, possible, report);
        continue;
      }
      inner = std::move(both);
    } else if (ids) {
      inner = ids;
    }
    // An IF without END reaches further than it was meant to, which is reported already.
    walk(choice.thenBody, choice.endRange ? inner : std::nullopt, report);
    walk(choice.elseBody, possible, report);
  }
}

void check(const Project& project, Report& report) {
  eachRoutine(project, [&](const compost::Program&, const compost::Routine& routine) {
    walk(routine.body, std::nullopt, report);
  });
}

} // namespace

DOTEK_LINT_RULE(branch_never_taken){
    .severity = Severity::Warning,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
