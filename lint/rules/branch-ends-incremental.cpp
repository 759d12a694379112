#include "lint/BranchSteps.h"

#include <algorithm>

namespace dotek::lint::rule {
namespace {

void check(const Project& project, Report& report) {
  for (const BranchSteps& branch : branchSteps(project)) {
    const BranchSteps::Step* incremental = nullptr;
    for (const BranchSteps::Step& step : branch.steps) {
      if (step.deeds.incremental) incremental = &step;
      if (step.deeds.absolute) incremental = nullptr;
    }
    const bool takenBack = std::any_of(branch.after.begin(), branch.after.end(),
                                       [](const BlockDeeds& deeds) { return deeds.absolute; });
    if (incremental == nullptr || takenBack) continue;
    report
        .at(incremental->range,
            "G91 is in force at the end of the branch for `{}`; coordinates that follow are taken as "
            "distances, and the tool goes elsewhere; write G90 after it",
            branch.id)
        .note(branch.branch, "the branch");
  }
}

} // namespace

DOTEK_LINT_RULE(branch_ends_incremental){
    .severity = Severity::Warning,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
