#include "frontend/macrob/Calls.h"
#include "lint/Project.h"

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

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

// The bound and the target of IF [..] GOTO with one comparison of a variable or a calculation.
struct Test {
  const macrob::Condition* condition = nullptr;
  std::string key; // comparison, bound, target
  bool absolute = false;
};

std::optional<Test> testOf(const macrob::If& branch, const Project& project) {
  const auto* jump = std::get_if<macrob::Goto>(&branch.statement);
  const auto* comparison =
      branch.condition ? std::get_if<macrob::Comparison>(&branch.condition->node) : nullptr;
  if (jump == nullptr || comparison == nullptr || !jump->target || !comparison->left || !comparison->right)
    return std::nullopt;
  if (!macrob::literal(*comparison->right) || *macrob::literal(*comparison->right) <= 0) return std::nullopt;
  const auto* function = std::get_if<frontend::nc::FunctionCall>(&comparison->left->node);
  return Test{branch.condition.get(),
              fmt::format("{} {} {}", comparison->op, project.sources.text(comparison->right->range),
                          project.sources.text(jump->target->range)),
              function != nullptr && function->name == "ABS"};
}

// Of several tests against one bound with one target all but this one are absolute.
void compareTests(const macrob::Program& program, const Project& project, Report& report) {
  std::vector<Test> tests;
  for (const macrob::Block& block : program.blocks)
    if (const auto* branch = std::get_if<macrob::If>(&block.body))
      if (auto test = testOf(*branch, project)) tests.push_back(std::move(*test));
  std::map<std::string_view, const Test*> absolute; // the first of each key
  for (const Test& test : tests)
    if (test.absolute) absolute.try_emplace(test.key, &test);
  for (const Test& test : tests) {
    const auto other = absolute.find(test.key);
    if (test.absolute || other == absolute.end()) continue;
    report
        .at(test.condition->range,
            "this test has the bound and the target of another one, which takes the absolute "
            "value; here each value of the other sign passes; write ABS")
        .note(other->second->condition->range, "the other test");
  }
}

void check(const Project& project, Report& report) {
  for (const NcFile& nc : project.programs)
    for (const macrob::Program& program : nc.file->programs)
      compareTests(program, project, report);
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
    .check = check,
};

} // namespace dotek::lint::rule
