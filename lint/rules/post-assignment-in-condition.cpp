#include "lint/Posts.h"

namespace dotek::lint::rule {
namespace {

void check(const Project& project, Report& report) {
  forEachPost(project, [&](const PostFile& post) {
    for (const fusion::Node& node : post.tree.nodes) {
      if (!node.is(fusion::Kind::If) && !node.is(fusion::Kind::While) && !node.is(fusion::Kind::Conditional))
        continue;
      const fusion::Node* const condition = node.kids[0]; // in brackets of its own it is meant
      if (condition != nullptr && condition->is(fusion::Kind::Assign) && condition->text == "=")
        report.at(post.tree.range(*condition), "`=` gives the variable a value here; `==` compares");
    }
  });
}

} // namespace

DOTEK_LINT_RULE(post_assignment_in_condition){
    .severity = Severity::Warning,
    .check = check,
};

} // namespace dotek::lint::rule
