#include "lint/PostEntries.h"

namespace dotek::lint::rule {
namespace {

void check(const Project& project, Report& report) {
  forEachPost(project, [&](const PostFile& post) {
    for (const TopFunction& one : topFunctions(post.tree)) {
      if (one.name->text != "onCommand") continue;
      bool refuses = false, any = false;
      walk(one.body(), [&](const fusion::Node& node) {
        if (node.is(fusion::Kind::Switch) || node.is(fusion::Kind::If)) any = true;
        if (!node.is(fusion::Kind::Call)) return;
        const std::string name = calledName(node);
        refuses = refuses || name == "onUnsupportedCommand" || name == "error" || name == "warning" ||
                  name == "warningOnce" || (name.starts_with("on") && name != "onCommand");
      });
      if (any && !refuses)
        report.at(post.tree.range(*one.name), "no branch of onCommand calls onUnsupportedCommand: a "
                                              "command that it does not know is passed over in silence");
    }
  });
}

} // namespace

DOTEK_LINT_RULE(post_command_not_reported){
    .severity = Severity::Note,
    .check = check,
};

} // namespace dotek::lint::rule
