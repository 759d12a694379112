#include "lint/ProgBlocks.h"

namespace dotek::lint::rule {
namespace {

void check(const Project& project, Report& report) {
  for (const Siblings& siblings : siblingsOf(project)) {
    for (std::size_t i = 0; i < siblings.branches.size(); ++i) {
      for (std::size_t j = i + 1; j < siblings.branches.size(); ++j) {
        const CycleBranch& first = siblings.branches[i];
        const CycleBranch& second = siblings.branches[j];
        if (first.id != second.id) continue;
        const auto plain = [](const CycleBranch& branch) {
          return branch.ref.branch->condition.terms.size() == 1 &&
                 branch.ref.branch->condition.terms.front().nots.empty();
        };
        const SourceRange outer = first.ref.branch->range;
        const bool inside = second.ref.branch->range.begin < outer.end;
        // Measuring calls in both: a frame around the cycle, before and after it, is no second posting.
        const auto measures = [&](const CycleBranch& branch) {
          for (const ProgBlock& block : branch.blocks)
            if (meaningOf(project, macroCalled(wordsOf(block, nullptr))).measures()) return true;
          return false;
        };
        if (inside || !plain(first) || !plain(second) || !measures(first) || !measures(second)) continue;
        report
            .at(second.ref.branch->ifRange,
                "this is the second branch of the routine that measures for `{}`; both are taken, and the "
                "operation "
                "is printed twice; one of the names is a misprint, or one branch is left over",
                first.id)
            .note(first.ref.branch->ifRange, "the first branch");
      }
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
