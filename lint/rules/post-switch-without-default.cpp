#include "lint/Posts.h"

namespace dotek::lint::rule {
namespace {

// Directly in onCyclePoint or onCommand: elsewhere a switch may only choose.
bool inEntry(const PostFile& post, const fusion::Node& node) {
  for (const fusion::Node* one : post.tree.body) {
    if (!one->is(fusion::Kind::Function) || one->begin > node.begin || one->end < node.end ||
        one->kids[0] == nullptr)
      continue;
    const std::string_view name = one->kids[0]->text;
    if (name != "onCyclePoint" && name != "onCommand") return false;
    // Something after it that ends or goes on with the rest.
    const auto& body = one->kids[2]->kids;
    return !body.empty() && body.back() == &node;
  }
  return false;
}

void check(const Project& project, Report& report) {
  forEachNode(project, fusion::Kind::Switch, [&](const PostFile& post, const fusion::Node& node) {
    const std::string name = fusion::dotted(fusion::bare(node.kids[0]));
    if (name != "cycleType" && name != "command") return;
    std::size_t real = 0;
    for (std::size_t i = 1; i < node.kids.size(); ++i) {
      if (node.kids[i]->kids[0] == nullptr) return;
      real += node.kids[i]->kids.size() > 1 ? 1 : 0;
    }
    if (real < 3 || !inEntry(post, node)) return;
    report.at({post.file, node.begin, node.begin + 6},
              "this switch of `{}` has no default: a {} that it does not name is passed over in silence",
              name, name == "command" ? "command" : "cycle");
  });
}

} // namespace

DOTEK_LINT_RULE(post_switch_without_default){
    .severity = Severity::Note,
    .check = check,
};

} // namespace dotek::lint::rule
