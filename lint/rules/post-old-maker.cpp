#include "lint/Posts.h"

namespace dotek::lint::rule {
namespace {

void check(const Project& project, Report& report) {
  forEachPost(project, [&](const PostFile& post) {
    const fusion::Node* const revision = fusion::bare(topLevelValue(post, "minimumRevision"));
    if (revision == nullptr || !revision->is(fusion::Kind::Number) || revision->text.size() != 5 ||
        revision->text < "45892")
      return;
    for (const fusion::Node& node : post.tree.nodes) {
      if (!node.is(fusion::Kind::Call)) continue;
      const std::string name = calledName(node);
      if (name == "createVariable" || name == "createReferenceVariable" ||
          name == "createIncrementalVariable") {
        report.at(post.tree.range(*node.kids[0]),
                  "{} is deprecated since revision 45892, which the post demands; createOutputVariable takes "
                  "its place",
                  name);
        return;
      }
    }
  });
}

} // namespace

DOTEK_LINT_RULE(post_old_maker){
    .severity = Severity::Note,
    .check = check,
};

} // namespace dotek::lint::rule
