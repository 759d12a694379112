#include "frontend/macrob/Calls.h"
#include "lint/Project.h"

#include <array>

namespace dotek::lint::rule {
namespace {

constexpr double kTolerance = 0.2; // mm or degrees; larger ones may be limits of one side

void checkCondition(const macrob::Condition& condition, Report& report) {
  if (const auto* joined = std::get_if<macrob::JoinedConditions>(&condition.node)) {
    if (joined->left) checkCondition(*joined->left, report);
    if (joined->right) checkCondition(*joined->right, report);
    return;
  }
  const auto& comparison = std::get<macrob::Comparison>(condition.node);
  if (!comparison.left || !comparison.right || (comparison.op != "LT" && comparison.op != "LE")) return;
  const auto* difference = std::get_if<frontend::nc::Operation>(&comparison.left->node);
  const auto bound = macrob::literal(*comparison.right);
  if (difference == nullptr || difference->op != "-" || !bound || *bound <= 0 || *bound > kTolerance) return;
  if (macrob::literal(*difference->right) == 0.0) return;
  report.at(
      condition.range,
      "the difference has a sign, and each negative one is below this tolerance; the test holds for any "
      "value that is too small; write ABS before the brackets");
}

void check(const Project& project, Report& report) {
  for (const NcFile& nc : project.programs)
    for (const macrob::Program& program : nc.file->programs)
      for (const macrob::Block& block : program.blocks)
        if (const auto* branch = std::get_if<macrob::If>(&block.body); branch != nullptr && branch->condition)
          checkCondition(*branch->condition, report);
}

} // namespace

DOTEK_LINT_RULE(difference_without_abs){
    .severity = Severity::Warning,
    .tier = Tier::Syntax,
    .explanation = "`IF[[#1-#2]LT0.01]` holds for each #1 below #2, however far. Two values are near one "
                   "another where the absolute difference is small.",
    .check = check,
};

} // namespace dotek::lint::rule
