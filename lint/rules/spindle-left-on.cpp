#include "lint/BranchSteps.h"

#include <algorithm>
#include <set>

namespace dotek::lint::rule {
namespace {

// How a branch comes to its first measurement.
struct Begin {
  const BranchSteps* branch = nullptr;
  const BranchSteps::Step* measured = nullptr;
  const BranchSteps::Step* coolant = nullptr; // is switched off before it
  bool stopped = false;                       // the spindle is
  bool oriented = false;                      // a macro may have done it: O9832 does in many packs
};

std::optional<Begin> beginOf(const BranchSteps& branch) {
  Begin begin{&branch, nullptr, nullptr, false, false};
  for (const BlockDeeds& deeds : branch.before) {
    begin.stopped = begin.stopped || deeds.stopsSpindle;
    begin.oriented = begin.oriented || deeds.switchesProbeOn;
  }
  for (const BranchSteps::Step& step : branch.steps) {
    if (step.deeds.measures) {
      begin.measured = &step;
      return begin;
    }
    begin.stopped = begin.stopped || step.deeds.stopsSpindle;
    begin.oriented = begin.oriented || step.deeds.switchesProbeOn;
    if (step.deeds.stopsCoolant) begin.coolant = &step;
  }
  return std::nullopt;
}

void check(const Project& project, Report& report) {
  const std::vector<BranchSteps> branches = branchSteps(project);
  std::vector<Begin> begins;
  for (const BranchSteps& branch : branches)
    if (const auto begin = beginOf(branch)) begins.push_back(*begin);
  std::set<std::pair<FileId, std::uint32_t>> told;
  for (const Begin& begin : begins) {
    if (begin.stopped) continue;
    const Begin* other = nullptr;
    std::ptrdiff_t with = 0;
    std::ptrdiff_t without = 0;
    for (const Begin& one : begins) {
      if (one.branch->prog != begin.branch->prog) continue;
      (one.stopped ? with : without) += 1;
      if (one.stopped && other == nullptr) other = &one;
    }
    // Who switches the coolant off for the probe means the spindle as well.
    const bool asOthers = other != nullptr && with >= without;
    if (!asOthers && (begin.coolant == nullptr || begin.oriented)) continue;
    const SourceRange at = asOthers ? begin.measured->range : begin.coolant->range;
    if (!told.insert({at.file, at.begin}).second) continue;
    if (asOthers)
      report
          .at(at,
              "nothing in the branch for `{}` stops the spindle before this measurement, as other branches "
              "do; a probe that turns breaks, or measures wrong; write M5 before it",
              begin.branch->id)
          .note(other->branch->branch, "the spindle is stopped for this one");
    else
      report
          .at(at,
              "the branch for `{}` switches the coolant off before it measures, and nothing stops the "
              "spindle; a probe that turns breaks, or measures wrong; write M5 beside it",
              begin.branch->id)
          .note(begin.measured->range, "the measurement");
  }
}

} // namespace

DOTEK_LINT_RULE(spindle_left_on){
    .severity = Severity::Warning,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
