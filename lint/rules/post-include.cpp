#include "lint/Posts.h"

namespace dotek::lint::rule {
namespace {

void check(const Project& project, Report& report) {
  forEachNode(project, fusion::Kind::Call, [&](const PostFile& post, const fusion::Node& node) {
    if (calledName(node) == "include" && node.kids.size() > 1 && post.whole)
      report.at(post.tree.range(*node.kids[0]),
                "a post with include works in a local folder; a cloud library refuses it");
  });
}

} // namespace

DOTEK_LINT_RULE(post_include){
    .severity = Severity::Note,
    .byDefault = false,
    .check = check,
};

} // namespace dotek::lint::rule
