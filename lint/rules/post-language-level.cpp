#include "lint/Posts.h"

#include <algorithm>

namespace dotek::lint::rule {
namespace {

constexpr std::string_view kBlockScope = "41600";

void check(const Project& project, Report& report) {
  forEachPost(project, [&](const PostFile& post) {
    const fusion::Node* const revision = fusion::bare(topLevelValue(post, "minimumRevision"));
    if (revision == nullptr || !revision->is(fusion::Kind::Number) || revision->text.size() > 5 ||
        revision->text >= kBlockScope)
      return;
    for (const fusion::Node& node : post.tree.nodes) {
      const bool newer = (node.is(fusion::Kind::Variables) && node.text != "var") ||
                         node.is(fusion::Kind::Arrow) || node.is(fusion::Kind::Class) ||
                         node.is(fusion::Kind::Template) || node.is(fusion::Kind::ForOf);
      if (!newer) continue;
      report.at({post.file, node.begin, std::min(node.end, node.begin + 5)},
                "this is newer JavaScript than the engines of revision {}, which `minimumRevision` allows",
                revision->text);
      return;
    }
  });
}

} // namespace

DOTEK_LINT_RULE(post_language_level){
    .severity = Severity::Note,
    .check = check,
};

} // namespace dotek::lint::rule
