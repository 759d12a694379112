#include "frontend/macrob/Check.h"
#include "frontend/macrob/Keywords.h"
#include "frontend/macrob/Walk.h"
#include "lint/Project.h"

#include <set>

namespace dotek::lint::rule {
namespace {

namespace nc = frontend::nc;

char letterOf(std::uint32_t variable) {
  for (char letter = 'A'; letter <= 'Z'; ++letter)
    if (macrob::argumentVariable(letter) == variable) return letter;
  return '\0';
}

bool isZero(const macrob::Expression& expression) {
  const auto* number = std::get_if<nc::Number>(&expression.node);
  return number != nullptr && number->value == 0;
}

void check(const macrob::CheckedProgram& input, Report& report) {
  if (!input.program.name || macrob::isMain(input.program)) return;
  std::set<std::uint32_t> tested; // for being empty
  for (const macrob::Condition* condition : input.conditions)
    macrob::eachComparison(*condition, [&](const macrob::Comparison& comparison, SourceRange) {
      const auto left = macrob::variableNumber(*comparison.left);
      const auto right = macrob::variableNumber(*comparison.right);
      if (left && right && *right == 0) tested.insert(*left);
      if (left && right && *left == 0) tested.insert(*right);
    });
  std::set<std::uint32_t> known; // set by the program, or told
  for (const macrob::Block& block : input.program.blocks) {
    if (const macrob::Condition* condition = macrob::conditionOf(block))
      macrob::eachComparison(*condition, [&](const macrob::Comparison& comparison, SourceRange range) {
        if (comparison.op != "EQ" && comparison.op != "NE") return;
        const bool onLeft = isZero(*comparison.right);
        if (!onLeft && !isZero(*comparison.left)) return;
        const auto variable = macrob::variableNumber(onLeft ? *comparison.left : *comparison.right);
        const char letter = variable ? letterOf(*variable) : '\0';
        if (letter == '\0' || tested.contains(*variable) || !known.insert(*variable).second) return;
        report.at(
            range,
            "#{0} is empty where the call leaves {1} out, and empty is not equal to 0, so the branch is {2}; "
            "write `#{0} EQ #0` where a call without {1} is meant",
            *variable, letter, comparison.op == "EQ" ? "not taken" : "taken");
      });
    const nc::Assignment* assignment = macrob::assignmentOf(block);
    const auto* target =
        assignment == nullptr ? nullptr : std::get_if<nc::Number>(&assignment->variable->node);
    if (target != nullptr && target->value >= 1 && target->value <= 33)
      known.insert(static_cast<std::uint32_t>(target->value));
  }
}

} // namespace

DOTEK_LINT_RULE(null_compared_with_zero){
    .severity = Severity::Note,
    .tier = Tier::Syntax,
    .parsed = check,
};

} // namespace dotek::lint::rule
