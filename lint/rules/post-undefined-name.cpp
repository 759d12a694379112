#include "lint/Posts.h"
#include "support/NearestName.h"
#include "support/WriteInstead.h"

#include <map>
#include <set>
#include <string_view>
#include <vector>

namespace dotek::lint::rule {
namespace {

// A name that the script tests with typeof may be there or not, and the post knows it.
void check(const Project& project, Report& report) {
  forEachPost(project, [&](const PostFile& post) {
    if (!post.whole || !post.tree.unread.empty()) return;
    bool includes = false;
    std::set<const fusion::Symbol*> known;
    for (const fusion::Use& use : post.scopes.uses) {
      if (use.kind != fusion::Use::Kind::Read) known.insert(use.symbol);
      includes = includes ||
                 (use.name->text == "include" && use.parent != nullptr && use.parent->is(fusion::Kind::Call));
    }
    if (includes) return; // another file may define what is missing
    std::map<const fusion::Symbol*, const fusion::Node*> first;
    for (const fusion::Use& use : post.scopes.uses) {
      const fusion::Symbol& symbol = *use.symbol;
      if (symbol.kind != fusion::Symbol::Kind::Global || known.contains(&symbol)) continue;
      if (post.names->all.contains(symbol.name)) continue;
      const auto at = first.try_emplace(&symbol, use.name).first;
      if (use.name->begin < at->second->begin) at->second = use.name;
    }
    std::vector<std::string_view> offered; // those of the post first
    for (const auto& [one, other] : post.scopes.scopes.front().names)
      if (other->kind != fusion::Symbol::Kind::Global) offered.push_back(one);
    offered.insert(offered.end(), post.names->all.begin(), post.names->all.end());
    for (const auto& [symbol, name] : first) {
      const std::string near = nearestName(symbol->name, offered);
      const SourceRange place = post.tree.range(*name);
      report
          .at(place, "`{}` is defined nowhere: the post stops where it comes here{}", symbol->name,
              near.empty() ? "" : "; did you mean `" + near + "`?")
          .fix = writeInstead(place, near);
    }
  });
}

} // namespace

DOTEK_LINT_RULE(post_undefined_name){
    .severity = Severity::Error,
    .check = check,
};

} // namespace dotek::lint::rule
