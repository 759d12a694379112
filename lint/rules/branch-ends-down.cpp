#include "lint/BranchSteps.h"

#include <algorithm>

namespace dotek::lint::rule {
namespace {

struct End {
  const BranchSteps* branch = nullptr;
  const BranchSteps::Step* measured = nullptr; // the last one
  std::size_t movesBefore = 0;                 // along Z
  bool up = false;                             // a move along Z follows, in the branch or after it
};

std::optional<End> endOf(const BranchSteps& branch) {
  End end{&branch, nullptr, 0, false};
  std::size_t moves = 0;
  for (const BranchSteps::Step& step : branch.steps) {
    if (step.deeds.measures) {
      end.measured = &step;
      end.movesBefore = moves;
      end.up = false;
    }
    if (!step.deeds.movesZ) continue;
    ++moves;
    end.up = end.measured != nullptr;
  }
  if (end.measured == nullptr) return std::nullopt;
  end.up = end.up || std::any_of(branch.after.begin(), branch.after.end(),
                                 [](const BlockDeeds& deeds) { return deeds.movesZ; });
  return end;
}

void check(const Project& project, Report& report) {
  const std::vector<BranchSteps> branches = branchSteps(project);
  std::vector<End> ends;
  for (const BranchSteps& branch : branches)
    if (const auto end = endOf(branch)) ends.push_back(*end);
  for (const End& end : ends) {
    // A web or a boss comes up by itself.
    if (end.up || end.measured->deeds.outside) continue;
    const auto others = [&](bool up) {
      return std::count_if(ends.begin(), ends.end(), [&](const End& other) {
        return &other != &end && other.branch->prog == end.branch->prog && other.up == up;
      });
    };
    // Two moves down before it, to a clearance and to the depth; or what the other branches do.
    const bool down = end.movesBefore > 1;
    if (!down && others(true) <= others(false)) continue;
    report
        .at(end.measured->range,
            "nothing takes the probe up after this measurement, the last one of the branch for `{}`; the "
            "next move of the machine goes through the part at this height; write the move along Z after it",
            end.branch->id)
        .note(end.branch->branch, "the branch");
  }
}

} // namespace

DOTEK_LINT_RULE(branch_ends_down){
    .severity = Severity::Warning,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
