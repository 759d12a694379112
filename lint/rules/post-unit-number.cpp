#include "lint/Posts.h"

namespace dotek::lint::rule {
namespace {

void check(const Project& project, Report& report) {
  forEachNode(project, fusion::Kind::Binary, [&](const PostFile& post, const fusion::Node& node) {
    if (node.text != "==" && node.text != "!=" && node.text != "===" && node.text != "!==") return;
    const fusion::Node* const left = fusion::bare(node.kids[0]);
    const fusion::Node* const right = fusion::bare(node.kids[1]);
    if ((left->isName("unit") && right->is(fusion::Kind::Number)) ||
        (right->isName("unit") && left->is(fusion::Kind::Number)))
      report.at(post.tree.range(node),
                "`unit` is compared with a number: the values of MM and IN are documented nowhere");
  });
}

} // namespace

DOTEK_LINT_RULE(post_unit_number){
    .severity = Severity::Note,
    .check = check,
};

} // namespace dotek::lint::rule
