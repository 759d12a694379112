#include "frontend/macrob/Calls.h"
#include "lint/Project.h"

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace dotek::lint::rule {
namespace {

constexpr double kTolerance = 0.2; // mm or degrees; larger ones may be limits of one side

template <class Visit> void eachComparison(const macrob::Condition& condition, const Visit& visit) {
  if (const auto* joined = std::get_if<macrob::JoinedConditions>(&condition.node)) {
    if (joined->left) eachComparison(*joined->left, visit);
    if (joined->right) eachComparison(*joined->right, visit);
    return;
  }
  if (const auto* comparison = std::get_if<macrob::Comparison>(&condition.node)) visit(*comparison);
}

// Without its outermost brackets and blanks.
std::string keyOf(const macrob::Expression& value, const Project& project) {
  std::string out;
  for (const char c : project.sources.text(value.range))
    if (c != ' ' && c != '\t') out += c;
  for (int brackets = 0;
       brackets < static_cast<int>(value.brackets) && out.starts_with('[') && out.ends_with(']'); ++brackets)
    out = out.substr(1, out.size() - 2);
  return out;
}

// What it is the other way round: `#2-#1` of `#1-#2`; "": no difference.
std::string turned(const macrob::Expression& value, const Project& project) {
  const auto* difference = std::get_if<frontend::nc::Operation>(&value.node);
  if (difference == nullptr || difference->op != "-") return "";
  return keyOf(*difference->right, project) + "-" + keyOf(*difference->left, project);
}

// A written number, in brackets or not.
std::optional<double> boundOf(const macrob::Expression& value) {
  if (const auto* number = std::get_if<frontend::nc::Number>(&value.node)) return number->value;
  const auto* negated = std::get_if<frontend::nc::Negated>(&value.node);
  const auto inner = negated == nullptr ? std::nullopt : boundOf(*negated->operand);
  return inner ? std::optional(-*inner) : std::nullopt;
}

bool isOrdered(const macrob::Comparison& comparison) {
  return comparison.op == "LT" || comparison.op == "LE" || comparison.op == "GT" || comparison.op == "GE";
}

// Values of which the program tests the other side, too, or the sign: each is signed on purpose.
std::set<std::string> testedBelow(const macrob::Program& program, const Project& project) {
  std::set<std::string> out;
  const auto take = [&](const macrob::Comparison& one) {
    if (!one.left || !one.right || !isOrdered(one)) return;
    const auto right = boundOf(*one.right), left = boundOf(*one.left);
    if (right && *right <= 0) out.insert(keyOf(*one.left, project));
    if (left && *left <= 0) out.insert(keyOf(*one.right, project));
    if (right)
      if (std::string other = turned(*one.left, project); !other.empty()) out.insert(std::move(other));
  };
  for (const macrob::Block& block : program.blocks) {
    if (const auto* branch = std::get_if<macrob::If>(&block.body); branch != nullptr && branch->condition)
      eachComparison(*branch->condition, take);
    if (const auto* loop = std::get_if<macrob::Do>(&block.body); loop != nullptr && loop->condition)
      eachComparison(*loop->condition, take);
  }
  return out;
}

void checkCondition(const macrob::Condition& condition, const std::set<std::string>& below,
                    const Project& project, Report& report) {
  if (const auto* joined = std::get_if<macrob::JoinedConditions>(&condition.node)) {
    if (joined->left) checkCondition(*joined->left, below, project, report);
    if (joined->right) checkCondition(*joined->right, below, project, report);
    return;
  }
  const auto& comparison = std::get<macrob::Comparison>(condition.node);
  if (!comparison.left || !comparison.right || (comparison.op != "LT" && comparison.op != "LE")) return;
  const auto* difference = std::get_if<frontend::nc::Operation>(&comparison.left->node);
  const auto bound = macrob::literal(*comparison.right);
  if (difference == nullptr || difference->op != "-" || !bound || *bound <= 0 || *bound > kTolerance) return;
  if (macrob::literal(*difference->right) == 0.0 || below.contains(keyOf(*comparison.left, project))) return;
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
  std::string value;
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
              function != nullptr && function->name == "ABS", keyOf(*comparison->left, project)};
}

// Of several tests against one bound with one target all but this one are absolute.
void compareTests(const macrob::Program& program, const std::set<std::string>& below, const Project& project,
                  Report& report) {
  std::vector<Test> tests;
  for (const macrob::Block& block : program.blocks)
    if (const auto* branch = std::get_if<macrob::If>(&block.body))
      if (auto test = testOf(*branch, project)) tests.push_back(std::move(*test));
  std::map<std::string_view, const Test*> absolute; // the first of each key
  for (const Test& test : tests)
    if (test.absolute) absolute.try_emplace(test.key, &test);
  for (const Test& test : tests) {
    const auto other = absolute.find(test.key);
    if (test.absolute || other == absolute.end() || below.contains(test.value)) continue;
    report
        .at(test.condition->range,
            "this test has the bound and the target of another one, which takes the absolute "
            "value; here each value of the other sign passes; write ABS")
        .note(other->second->condition->range, "the other test");
  }
}

void check(const Project& project, Report& report) {
  for (const NcFile& nc : project.programs)
    for (const macrob::Program& program : nc.file->programs) {
      const std::set<std::string> below = testedBelow(program, project);
      compareTests(program, below, project, report);
      for (const macrob::Block& block : program.blocks)
        if (const auto* branch = std::get_if<macrob::If>(&block.body); branch != nullptr && branch->condition)
          checkCondition(*branch->condition, below, project, report);
    }
}

} // namespace

DOTEK_LINT_RULE(difference_without_abs){
    .severity = Severity::Warning,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
