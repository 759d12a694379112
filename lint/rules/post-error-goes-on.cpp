#include "lint/Posts.h"

namespace dotek::lint::rule {
namespace {

bool writes(const fusion::Node* statement) {
  bool out = false;
  walk(statement, [&](const fusion::Node& node) {
    if (!node.is(fusion::Kind::Call)) return;
    const std::string name = calledName(node);
    out = out || name == "writeBlock" || name == "writeln" || name == "writeWords" || name == "writeComment";
  });
  return out;
}

void check(const Project& project, Report& report) {
  forEachPost(project, [&](const PostFile& post) {
    const auto judge = [&](const std::vector<fusion::Node*>& body, std::size_t first) {
      for (std::size_t i = first; i + 1 < body.size(); ++i) {
        const fusion::Node* const one = body[i];
        if (one == nullptr || !one->is(fusion::Kind::Evaluate) || !one->kids[0]->is(fusion::Kind::Call))
          continue;
        if (calledName(*one->kids[0]) != "error") continue;
        const fusion::Node* const next = body[i + 1];
        if (!writes(next)) continue;
        report.at(post.tree.range(*one->kids[0]->kids[0]),
                  "blocks are written after this error: whether the engine stops at it is not stated");
      }
    };
    for (const fusion::Node& node : post.tree.nodes) {
      if (node.is(fusion::Kind::Block)) judge(node.kids, 0);
      if (node.is(fusion::Kind::Case)) judge(node.kids, 1);
    }
  });
}

} // namespace

DOTEK_LINT_RULE(post_error_goes_on){
    .severity = Severity::Note,
    .check = check,
};

} // namespace dotek::lint::rule
