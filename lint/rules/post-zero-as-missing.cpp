#include "lint/Posts.h"

namespace dotek::lint::rule {
namespace {

bool isMeasure(std::string_view name) {
  return name.find("Correction") != std::string_view::npos || name.find("Angle") != std::string_view::npos ||
         name.find("tolerance") == 0 || name.find("Threshold") != std::string_view::npos || name == "depth" ||
         name == "dwell";
}

void check(const Project& project, Report& report) {
  forEachNode(project, fusion::Kind::Conditional, [&](const PostFile& post, const fusion::Node& node) {
    const fusion::Node* const tested = fusion::bare(node.kids[0]);
    const std::string name = fusion::dotted(tested);
    if (!name.starts_with("cycle.") || !isMeasure(name.substr(6))) return;
    const fusion::Node* const otherwise = fusion::bare(node.kids[2]);
    if (!otherwise->is(fusion::Kind::Number) ||
        otherwise->text.find_first_not_of("0.") == std::string_view::npos)
      return;
    bool used = false;
    walk(node.kids[1], [&](const fusion::Node& part) { used = used || fusion::dotted(&part) == name; });
    if (used)
      report.at(post.tree.range(*tested),
                "a value of 0 counts as missing here, and {} is printed in its place; `{} !== undefined` "
                "asks whether it is there",
                otherwise->text, name);
  });
}

} // namespace

DOTEK_LINT_RULE(post_zero_as_missing){
    .severity = Severity::Note,
    .check = check,
};

} // namespace dotek::lint::rule
