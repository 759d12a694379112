#include "lint/Posts.h"

#include <map>
#include <set>

namespace dotek::lint::rule {
namespace {

void check(const Project& project, Report& report) {
  forEachPost(project, [&](const PostFile& post) {
    std::set<std::string_view> printed, claimed;
    std::map<std::string_view, const fusion::Node*> places;
    const auto collect = [&](const fusion::Node& function, std::set<std::string_view>& into, bool place) {
      walk(&function, [&](const fusion::Node& node) {
        if (!node.is(fusion::Kind::String)) return;
        const std::string_view text = fusion::stringText(node);
        if (!text.starts_with("probing-")) return;
        into.insert(text);
        if (place) places.try_emplace(text, &node);
      });
    };
    bool any = false;
    for (const fusion::Node* one : post.tree.body) {
      if (!one->is(fusion::Kind::Function) || one->kids[0] == nullptr) continue;
      if (one->kids[0]->text == "isProbingCycle") {
        any = true;
        collect(*one, claimed, true);
      } else {
        collect(*one, printed, false);
      }
    }
    if (!any) return;
    for (const std::string_view type : claimed)
      if (!printed.contains(type))
        report.at(post.tree.range(*places[type]),
                  "`{}` is called a probing cycle here, and no function of the post prints it", type);
  });
}

} // namespace

DOTEK_LINT_RULE(post_cycle_claimed){
    .severity = Severity::Warning,
    .check = check,
};

} // namespace dotek::lint::rule
