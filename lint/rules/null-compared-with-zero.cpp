#include "frontend/macrob/Check.h"
#include "frontend/macrob/Keywords.h"
#include "frontend/macrob/Walk.h"
#include "lint/Project.h"

#include <optional>
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

// The one variable that a comparison holds against a number; nothing: more than that.
std::optional<std::uint32_t> comparedVariable(const macrob::Condition& condition) {
  const auto* one = std::get_if<macrob::Comparison>(&condition.node);
  if (one == nullptr) return std::nullopt;
  const bool onLeft = std::holds_alternative<nc::Number>(one->right->node);
  if (!onLeft && !std::holds_alternative<nc::Number>(one->left->node)) return std::nullopt;
  return macrob::variableNumber(onLeft ? *one->left : *one->right);
}

// Whoever passes the tests of this variable from here on, none of them being met, gets to an alarm: an empty
// argument is refused like any other that fits nowhere.
bool endsInAlarm(const macrob::Program& program, std::size_t at, std::uint32_t variable) {
  const auto blockOf = [&](const macrob::Goto& jump) {
    const auto* number = std::get_if<nc::Number>(&jump.target->node);
    std::size_t i = 0;
    while (i < program.blocks.size() &&
           (number == nullptr || !program.blocks[i].sequenceNumber ||
            static_cast<double>(program.blocks[i].sequenceNumber->value) != number->value))
      ++i;
    return i;
  };
  for (int steps = 0; at < program.blocks.size() && steps < 40; ++steps) {
    const macrob::Body& body = program.blocks[at].body;
    if (const auto* jump = std::get_if<macrob::Goto>(&body)) {
      at = blockOf(*jump);
    } else if (const auto* branch = std::get_if<macrob::If>(&body)) {
      const auto* one = std::get_if<macrob::Comparison>(&branch->condition->node);
      if (one == nullptr || one->op != "EQ" || comparedVariable(*branch->condition) != variable) return false;
      ++at;
    } else if (const auto* set = std::get_if<nc::Assignment>(&body)) {
      const auto* target = std::get_if<nc::Number>(&set->variable->node);
      return target != nullptr && target->value == 3000;
    } else if (const auto* words = std::get_if<macrob::Words>(&body)) {
      // The coolant goes off, a dwell, a retract; no end, and no call.
      for (const nc::Word& word : words->words) {
        const auto* number = word.value == nullptr ? nullptr : std::get_if<nc::Number>(&word.value->node);
        if ((word.address == 'M' && (number == nullptr || number->value >= 30 || number->value == 2)) ||
            (word.address == 'G' && (number == nullptr || number->value >= 65)))
          return false;
      }
      ++at;
    } else if (std::holds_alternative<std::monostate>(body)) {
      ++at;
    } else {
      return false;
    }
  }
  return false;
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
        const auto place = static_cast<std::size_t>(&block - input.program.blocks.data());
        if (comparison.op == "EQ" && endsInAlarm(input.program, place, *variable)) return;
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
