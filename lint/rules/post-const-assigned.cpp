#include "lint/Posts.h"

namespace dotek::lint::rule {
namespace {

void check(const Project& project, Report& report) {
  forEachPost(project, [&](const PostFile& post) {
    for (const fusion::Use& use : post.scopes.uses) {
      if (use.symbol->kind != fusion::Symbol::Kind::Const || use.name == use.symbol->declaration ||
          (use.kind != fusion::Use::Kind::Write && use.kind != fusion::Use::Kind::ReadWrite))
        continue;
      report.at(post.tree.range(*use.name),
                "`{}` is declared by `const` and keeps its first value: the post stops here, or goes on with "
                "the old one; declare it by `let`",
                use.symbol->name);
    }
  });
}

} // namespace

DOTEK_LINT_RULE(post_const_assigned){
    .severity = Severity::Warning,
    .check = check,
};

} // namespace dotek::lint::rule
