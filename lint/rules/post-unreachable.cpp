#include "lint/Posts.h"

namespace dotek::lint::rule {
namespace {

void check(const Project& project, Report& report) {
  forEachPost(project, [&](const PostFile& post) {
    const auto judge = [&](const std::vector<fusion::Node*>& body, std::size_t first) {
      for (std::size_t i = first; i + 1 < body.size(); ++i) {
        const fusion::Node* const one = body[i];
        if (one == nullptr) continue;
        if (!one->is(fusion::Kind::Return) && !one->is(fusion::Kind::Throw) &&
            !one->is(fusion::Kind::Continue) && !one->is(fusion::Kind::Break))
          continue;
        const fusion::Node* const next = body[i + 1];
        if (next == nullptr || next->is(fusion::Kind::Function) || next->is(fusion::Kind::Empty) ||
            next->is(fusion::Kind::Break) || next->is(fusion::Kind::Variables) ||
            next->is(fusion::Kind::Return))
          continue;
        report.at(post.tree.range(*next), "this is never reached: the statement before it leaves");
        return;
      }
    };
    for (const fusion::Node& node : post.tree.nodes) {
      if (node.is(fusion::Kind::Block)) judge(node.kids, 0);
      if (node.is(fusion::Kind::Case)) judge(node.kids, 1);
    }
  });
}

} // namespace

DOTEK_LINT_RULE(post_unreachable){
    .severity = Severity::Note,
    .check = check,
};

} // namespace dotek::lint::rule
