#include "lint/Posts.h"

namespace dotek::lint::rule {
namespace {

bool isBuilt(const fusion::Node& call) {
  if (calledName(call) != "localize" || call.kids.size() < 2) return false;
  const fusion::Node* const text = fusion::bare(call.kids[1]);
  if (text->is(fusion::Kind::Call) && text->kids[0]->is(fusion::Kind::Member) &&
      text->kids[0]->kids[1]->text == "concat" && !textLiteral(text->kids[0]->kids[0]).empty())
    return true;
  if (!text->is(fusion::Kind::Binary) && !text->is(fusion::Kind::Template)) return false;
  bool variable = false;
  walk(text, [&](const fusion::Node& part) {
    variable = variable || (part.is(fusion::Kind::Name) && part.text != "EOL") || part.is(fusion::Kind::Call);
  });
  return variable;
}

// A habit of its author: one finding for a post.
void check(const Project& project, Report& report) {
  forEachPost(project, [&](const PostFile& post) {
    const fusion::Node* first = nullptr;
    std::size_t count = 0;
    for (const fusion::Node& node : post.tree.nodes) {
      if (!node.is(fusion::Kind::Call) || !isBuilt(node)) continue;
      ++count;
      if (first == nullptr || node.begin < first->begin) first = &node;
    }
    if (first == nullptr) return;
    const std::string more =
        count == 1 ? "" : " (as do " + std::to_string(count - 1) + " others of this post)";
    report.at(post.tree.range(*fusion::bare(first->kids[1])),
              "localize looks up this text after it was put together: no translation has it{}; write "
              "subst(localize(\".. %1\"), value)",
              more);
  });
}

} // namespace

DOTEK_LINT_RULE(post_localize_built){
    .severity = Severity::Note,
    .check = check,
};

} // namespace dotek::lint::rule
