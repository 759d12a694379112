#include "lint/ProgBlocks.h"

#include <algorithm>
#include <set>

namespace dotek::lint::rule {
namespace {

void check(const Project& project, Report& report) {
  if (project.progs.empty()) return;
  std::set<std::string> tested;
  for (const compost::Program* prog : project.progs) {
    if (prog->hasErrorNodes) return;
    for (const std::string& id : compost::cycleIds(*prog))
      tested.insert(id);
  }
  std::set<std::string> folders;
  for (const gibbs::Cycle* cycle : project.cycles)
    folders.insert(cycle->name);
  // Posts of these folders: each branch is for one of them. Another name is likely the misprint of one.
  const bool all =
      std::all_of(tested.begin(), tested.end(), [&](const std::string& id) { return folders.contains(id); });
  if (tested.empty() || !all) return;
  for (const gibbs::Cycle* cycle : project.cycles) {
    if (tested.contains(cycle->name) || !cycle->defineData) continue;
    const auto& definitions = cycle->defineData->definitions;
    if (definitions.empty()) continue;
    report.at(definitions.front().range,
              "no branch of the post is for `{}`, as it is for the other cycles given; an operation with it "
              "prints nothing, and the machine goes on without it; write a branch",
              cycle->name);
  }
}

} // namespace

DOTEK_LINT_RULE(cycle_without_branch){
    .severity = Severity::Warning,
    .tier = Tier::Bundle,
    .check = check,
};

} // namespace dotek::lint::rule
