#include "lint/Posts.h"

#include <algorithm>
#include <array>

namespace dotek::lint::rule {
namespace {

bool isPlain(const fusion::Node& node) {
  if (node.is(fusion::Kind::Call)) { // a question of the engine has one answer
    const fusion::Node& called = *fusion::bare(node.kids[0]);
    const std::string_view name = called.is(fusion::Kind::Member) ? called.kids[1]->text : called.text;
    if (called.is(fusion::Kind::Member) ? !isPlain(*fusion::bare(called.kids[0]))
                                        : !called.is(fusion::Kind::Name))
      return false;
    if (!name.starts_with("get") && !name.starts_with("is") && !name.starts_with("has")) return false;
    return std::all_of(node.kids.begin() + 1, node.kids.end(), [](const fusion::Node* one) {
      return fusion::bare(one)->is(fusion::Kind::Number) || fusion::bare(one)->is(fusion::Kind::String) ||
             isPlain(*fusion::bare(one));
    });
  }
  return node.is(fusion::Kind::Name) ||
         (node.is(fusion::Kind::Member) && isPlain(*fusion::bare(node.kids[0])));
}

void check(const Project& project, Report& report) {
  forEachNode(project, fusion::Kind::Binary, [&](const PostFile& post, const fusion::Node& node) {
    constexpr auto kSigns =
        std::to_array<std::string_view>({"==", "===", "!=", "!==", "<", ">", "<=", ">=", "&&", "||", "-"});
    if (std::find(kSigns.begin(), kSigns.end(), node.text) == kSigns.end()) return;
    const fusion::Node* const left = fusion::bare(node.kids[0]);
    const fusion::Node* const right = fusion::bare(node.kids[1]);
    if (!isPlain(*left) || left->is(fusion::Kind::Number) ||
        post.tree.textOf(*left) != post.tree.textOf(*right))
      return;
    if ((node.text == "!=" || node.text == "!==") && left->is(fusion::Kind::Name)) return; // asks for NaN
    report.at(post.tree.range(node), "both sides of `{}` are the same", node.text);
  });
}

} // namespace

DOTEK_LINT_RULE(post_compared_with_itself){
    .severity = Severity::Warning,
    .check = check,
};

} // namespace dotek::lint::rule
