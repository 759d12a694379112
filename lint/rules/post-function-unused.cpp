#include "lint/Posts.h"

#include <set>

namespace dotek::lint::rule {
namespace {

void check(const Project& project, Report& report) {
  forEachPost(project, [&](const PostFile& post) {
    if (!post.whole || !post.tree.unread.empty()) return;
    std::set<const fusion::Symbol*> used;
    std::set<std::string_view> texts;
    for (const fusion::Use& use : post.scopes.uses) {
      const fusion::Symbol& symbol = *use.symbol;
      const bool within = symbol.value != nullptr && use.name->begin >= symbol.value->begin &&
                          use.name->end <= symbol.value->end;
      if (!within) used.insert(&symbol);
      if (use.name->text == "include" || use.name->text == "eval") return;
    }
    for (const fusion::Node& node : post.tree.nodes)
      if (node.is(fusion::Kind::String)) texts.insert(fusion::stringText(node));
    for (const auto& [name, symbol] : post.scopes.scopes.front().names) {
      if (symbol->kind != fusion::Symbol::Kind::Function || used.contains(symbol) || texts.contains(name))
        continue;
      if (post.names->all.contains(name) || name.starts_with("on")) continue;
      report.at(post.tree.range(*symbol->declaration), "the function `{}` is called nowhere", name);
    }
  });
}

} // namespace

DOTEK_LINT_RULE(post_function_unused){
    .severity = Severity::Note,
    .byDefault = false,
    .check = check,
};

} // namespace dotek::lint::rule
