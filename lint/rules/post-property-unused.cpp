#include "lint/Posts.h"

#include <set>

namespace dotek::lint::rule {
namespace {

void check(const Project& project, Report& report) {
  forEachPost(project, [&](const PostFile& post) {
    const fusion::Node* const all = fusion::bare(topLevelValue(post, "properties"));
    if (!post.whole || all == nullptr || !all->is(fusion::Kind::Object)) return;
    std::set<std::string_view> read;
    bool computed = false;
    for (const fusion::Node& node : post.tree.nodes) {
      if (node.is(fusion::Kind::Member)) read.insert(node.kids[1]->text);
      if (node.is(fusion::Kind::String)) read.insert(fusion::stringText(node));
      if (node.is(fusion::Kind::Index) && node.kids[0]->isName("properties")) computed = true;
      if (node.is(fusion::Kind::Call) && calledName(node) == "getProperty" && node.kids.size() > 1 &&
          !fusion::bare(node.kids[1])->is(fusion::Kind::String) &&
          !fusion::bare(node.kids[1])->is(fusion::Kind::Member))
        computed = true;
    }
    if (computed) return;
    for (const fusion::Node* one : all->kids)
      if (one->is(fusion::Kind::Property) && !read.contains(keyOf(*one)))
        report.at(post.tree.range(*one->kids[0]),
                  "the property `{}` is read nowhere: what the user chooses changes nothing", keyOf(*one));
  });
}

} // namespace

DOTEK_LINT_RULE(post_property_unused){
    .severity = Severity::Note,
    .check = check,
};

} // namespace dotek::lint::rule
