#include "lint/Posts.h"

#include <map>

namespace dotek::lint::rule {
namespace {

void check(const Project& project, Report& report) {
  forEachNode(project, fusion::Kind::Switch, [&](const PostFile& post, const fusion::Node& node) {
    std::map<std::string_view, const fusion::Node*> seen;
    for (std::size_t i = 1; i < node.kids.size(); ++i) {
      const fusion::Node* const value = node.kids[i]->kids[0];
      if (value == nullptr) continue;
      const auto [at, isNew] = seen.try_emplace(post.tree.textOf(*value), value);
      if (!isNew)
        report
            .at(post.tree.range(*value), "`{}` has a case before, and this one is never reached",
                post.tree.textOf(*value))
            .note(post.tree.range(*at->second), "the first one");
    }
  });
}

} // namespace

DOTEK_LINT_RULE(post_duplicate_case){
    .severity = Severity::Warning,
    .check = check,
};

} // namespace dotek::lint::rule
