#include "lint/Posts.h"

#include <map>

namespace dotek::lint::rule {
namespace {

void check(const Project& project, Report& report) {
  forEachNode(project, fusion::Kind::Object, [&](const PostFile& post, const fusion::Node& node) {
    std::map<std::string_view, const fusion::Node*> seen;
    for (const fusion::Node* one : node.kids) {
      if (!one->is(fusion::Kind::Property) || one->kids[0]->is(fusion::Kind::Computed)) continue;
      const auto [at, isNew] = seen.try_emplace(keyOf(*one), one->kids[0]);
      if (!isNew)
        report
            .at(post.tree.range(*one->kids[0]), "`{}` is given a second time: the first value is lost",
                keyOf(*one))
            .note(post.tree.range(*at->second), "the first one");
    }
  });
}

} // namespace

DOTEK_LINT_RULE(post_duplicate_key){
    .severity = Severity::Warning,
    .check = check,
};

} // namespace dotek::lint::rule
