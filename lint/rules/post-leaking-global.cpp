#include "lint/Posts.h"

#include <map>
#include <set>

namespace dotek::lint::rule {
namespace {

void check(const Project& project, Report& report) {
  forEachPost(project, [&](const PostFile& post) {
    if (!post.tree.unread.empty()) return;
    std::map<const fusion::Symbol*, const fusion::Use*> first;
    std::set<const fusion::Symbol*> atTop;
    for (const fusion::Use& use : post.scopes.uses) {
      if (use.symbol->kind != fusion::Symbol::Kind::Global || use.kind == fusion::Use::Kind::Read) continue;
      if (post.names->all.contains(use.symbol->name)) continue;
      if (use.kind == fusion::Use::Kind::TypeOf || use.scope->function->parent == nullptr)
        atTop.insert(use.symbol);
      const auto at = first.try_emplace(use.symbol, &use).first;
      if (use.name->begin < at->second->name->begin) at->second = &use;
    }
    for (const auto& [symbol, use] : first)
      if (!atTop.contains(symbol))
        report.at(post.tree.range(*use->name),
                  "`{}` is declared nowhere: the value stays for all functions and operations; write `var`",
                  symbol->name);
  });
}

} // namespace

DOTEK_LINT_RULE(post_leaking_global){
    .severity = Severity::Note,
    .check = check,
};

} // namespace dotek::lint::rule
