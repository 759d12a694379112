#include "lint/Posts.h"

#include <algorithm>
#include <array>

namespace dotek::lint::rule {
namespace {

void check(const Project& project, Report& report) {
  // `tool.diameter / 25`
  forEachNode(project, fusion::Kind::Binary, [&](const PostFile& post, const fusion::Node& node) {
    const fusion::Node* const number = fusion::bare(node.kids[1]);
    if ((node.text != "/" && node.text != "*") || !number->is(fusion::Kind::Number) || number->text != "25")
      return;
    const std::string name = fusion::dotted(fusion::bare(node.kids[0]));
    if (name == "tool.diameter" || name == "tool.cornerRadius" || name == "cycle.depth" ||
        name.starts_with("cycle.width") || name.starts_with("cycle.probe"))
      report.at(post.tree.range(*number), "an inch has 25.4 mm: `{}` comes out 1.6 percent off", name);
  });
  constexpr auto kDimensions = std::to_array<std::string_view>({"cycle", "tool"});
  forEachNode(project, fusion::Kind::Call, [&](const PostFile& post, const fusion::Node& node) {
    const std::string name = calledName(node);
    if ((name != "spatial" && name != "toUnit") || node.kids.size() < 2) return;
    bool measured = false;
    walk(node.kids[1], [&](const fusion::Node& part) {
      if (part.is(fusion::Kind::Member) && part.kids[0]->is(fusion::Kind::Name))
        measured = measured ||
                   std::find(kDimensions.begin(), kDimensions.end(), part.kids[0]->text) != kDimensions.end();
    });
    if (measured)
      report.at(post.tree.range(*node.kids[0]),
                "{} takes an inch for 25 mm, to give round defaults; of a dimension toPreciseUnit takes 25.4",
                name);
  });
}

} // namespace

DOTEK_LINT_RULE(post_round_inch){
    .severity = Severity::Note,
    .check = check,
};

} // namespace dotek::lint::rule
