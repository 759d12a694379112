#include "frontend/macrob/Calls.h"
#include "lint/Project.h"

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dotek::lint::rule {
namespace {

// IF[ABS[..]GT 0.1]GOTO 90: the bound and the target, and whether the test asks for more.
struct Test {
  SourceRange range;
  std::string key;
  bool more = false;
};

std::optional<Test> testOf(const macrob::If& branch, const Project& project) {
  const auto* jump = std::get_if<macrob::Goto>(&branch.statement);
  const auto* comparison =
      branch.condition ? std::get_if<macrob::Comparison>(&branch.condition->node) : nullptr;
  if (jump == nullptr || comparison == nullptr || !jump->target || !comparison->left || !comparison->right)
    return std::nullopt;
  const auto* function = std::get_if<frontend::nc::FunctionCall>(&comparison->left->node);
  if (function == nullptr || function->name != "ABS" || !macrob::literal(*comparison->right))
    return std::nullopt;
  const bool more = comparison->op == "GT" || comparison->op == "GE";
  if (!more && comparison->op != "LT" && comparison->op != "LE") return std::nullopt;
  return Test{branch.condition->range,
              fmt::format("{} {}", project.sources.text(comparison->right->range),
                          project.sources.text(jump->target->range)),
              more};
}

void check(const Project& project, Report& report) {
  for (const NcFile& nc : project.programs) {
    for (const macrob::Program& program : nc.file->programs) {
      std::vector<Test> tests;
      for (const macrob::Block& block : program.blocks)
        if (const auto* branch = std::get_if<macrob::If>(&block.body))
          if (auto test = testOf(*branch, project)) tests.push_back(std::move(*test));
      std::map<std::pair<std::string_view, bool>, const Test*> first; // of each key and direction
      for (const Test& test : tests) {
        const auto other = first.find({test.key, !test.more});
        first.try_emplace({test.key, test.more}, &test);
        if (other == first.end()) continue;
        report
            .at(test.range,
                "this jumps where the value is {} the bound, and another test with the same bound "
                "and target where it is {}; one of the two comparisons is turned round",
                test.more ? "above" : "below", test.more ? "below" : "above")
            .note(other->second->range, "the other test");
      }
    }
  }
}

} // namespace

DOTEK_LINT_RULE(comparison_opposite){
    .severity = Severity::Warning,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
