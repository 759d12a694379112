#include "frontend/fusion/Units.h"
#include "lint/Posts.h"

namespace dotek::lint::rule {
namespace {

void check(const Project& project, Report& report) {
  forEachPost(project, [&](const PostFile& post) {
    for (const fusion::Node* one : fusion::unitsAsNumbers(post.tree, post.scopes))
      report.at(post.tree.range(*one), "`unit` is compared with a number or taken for one: the values of MM "
                                       "and IN are documented nowhere");
  });
}

} // namespace

DOTEK_LINT_RULE(post_unit_number){
    .severity = Severity::Note,
    .check = check,
};

} // namespace dotek::lint::rule
