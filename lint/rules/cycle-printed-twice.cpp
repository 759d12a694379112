#include "lint/ProgBlocks.h"

#include <algorithm>
#include <map>
#include <string_view>

namespace dotek::lint::rule {
namespace {

bool plain(const CycleBranch& branch) {
  return branch.ref.branch->condition.terms.size() == 1 &&
         branch.ref.branch->condition.terms.front().nots.empty();
}

bool measures(const CycleBranch& branch, const Project& project) {
  return std::any_of(branch.blocks.begin(), branch.blocks.end(), [&](const ProgBlock& block) {
    return meaningOf(project, macroCalled(wordsOf(block, nullptr))).measures();
  });
}

void check(const Project& project, Report& report) {
  for (const Siblings& siblings : siblingsOf(project)) {
    // Measuring calls in both: a frame around the cycle, before and after it, is no second posting.
    std::map<std::string_view, std::vector<const CycleBranch*>> posted;
    for (const CycleBranch& second : siblings.branches) {
      if (!plain(second) || !measures(second, project)) continue;
      std::vector<const CycleBranch*>& before = posted[second.id];
      const auto first = std::find_if(before.begin(), before.end(), [&](const CycleBranch* one) {
        return second.ref.branch->range.begin >= one->ref.branch->range.end;
      });
      if (first != before.end())
        report
            .at(second.ref.branch->ifRange,
                "this is the second branch of the routine that measures for `{}`; both are taken, and the "
                "operation "
                "is printed twice; one of the names is a misprint, or one branch is left over",
                second.id)
            .note((*first)->ref.branch->ifRange, "the first branch");
      before.push_back(&second);
    }
  }
}

} // namespace

DOTEK_LINT_RULE(cycle_printed_twice){
    .severity = Severity::Warning,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
