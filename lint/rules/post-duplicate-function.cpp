#include "lint/Posts.h"

#include <map>

namespace dotek::lint::rule {
namespace {

void check(const Project& project, Report& report) {
  forEachPost(project, [&](const PostFile& post) {
    std::map<std::string_view, const fusion::Node*> seen;
    for (const fusion::Node* one : post.tree.body) {
      if (!one->is(fusion::Kind::Function) || one->kids[0] == nullptr) continue;
      const auto [at, isNew] = seen.try_emplace(one->kids[0]->text, one->kids[0]);
      if (!isNew)
        report
            .at(post.tree.range(*one->kids[0]),
                "the function `{}` is defined a second time: the first one is never called",
                one->kids[0]->text)
            .note(post.tree.range(*at->second), "the first one");
    }
  });
}

} // namespace

DOTEK_LINT_RULE(post_duplicate_function){
    .severity = Severity::Warning,
    .check = check,
};

} // namespace dotek::lint::rule
