#include "lint/PostEntries.h"

#include <algorithm>
#include <map>
#include <set>

namespace dotek::lint::rule {
namespace {

void check(const Project& project, Report& report) {
  forEachPost(project, [&](const PostFile& post) {
    std::set<std::string_view> printed, claimed;
    std::map<std::string_view, const fusion::Node*> places;
    const std::vector<TopFunction> top = topFunctions(post.tree);
    const auto claims = std::find_if(
        top.begin(), top.end(), [](const TopFunction& one) { return one.name->text == "isProbingCycle"; });
    if (claims == top.end()) return;
    const fusion::Node& own = *claims->function;
    for (const fusion::Node& node : post.tree.nodes) {
      if (!node.is(fusion::Kind::String)) continue;
      const std::string_view text = fusion::stringText(node);
      if (!text.starts_with("probing-")) continue;
      const bool inside = node.begin >= own.begin && node.end <= own.end;
      (inside ? claimed : printed).insert(text);
      if (inside) places.try_emplace(text, &node);
    }
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
