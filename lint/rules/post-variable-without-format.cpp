#include "lint/Posts.h"

namespace dotek::lint::rule {
namespace {

void check(const Project& project, Report& report) {
  forEachNode(project, fusion::Kind::Call, [&](const PostFile& post, const fusion::Node& node) {
    const std::string name = calledName(node);
    if (name != "createVariable" && name != "createModal" && name != "createReferenceVariable" &&
        name != "createOutputVariable" && name != "createIncrementalVariable")
      return;
    if (node.kids.size() == 2 && propertyOf(fusion::bare(node.kids[1]), "format") == nullptr &&
        fusion::bare(node.kids[1])->is(fusion::Kind::Object))
      report.at(post.tree.range(*node.kids[0]), "{} has no format: it fails with its first value", name);
  });
}

} // namespace

DOTEK_LINT_RULE(post_variable_without_format){
    .severity = Severity::Error,
    .check = check,
};

} // namespace dotek::lint::rule
