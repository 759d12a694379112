#include "lint/Posts.h"

namespace dotek::lint::rule {
namespace {

void check(const Project& project, Report& report) {
  forEachPost(project, [&](const PostFile& post) {
    for (const SourceRange& one : post.tree.tokens.mergeMarkers)
      report.at(one, "a conflict that a version control left here: Fusion does not load the post");
  });
}

} // namespace

DOTEK_LINT_RULE(post_merge_marker){
    .severity = Severity::Error,
    .check = check,
};

} // namespace dotek::lint::rule
