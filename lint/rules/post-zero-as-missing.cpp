#include "lint/Posts.h"

namespace dotek::lint::rule {
namespace {

bool isMeasure(std::string_view name) {
  return name.find("Correction") != std::string_view::npos || name.find("Angle") != std::string_view::npos ||
         name.find("tolerance") == 0 || name.find("Threshold") != std::string_view::npos || name == "depth" ||
         name == "dwell";
}

bool isOther(const fusion::Node* node) { // a number that is not 0
  node = fusion::bare(node);
  return node != nullptr && node->is(fusion::Kind::Number) &&
         node->text.find_first_not_of("0.") != std::string_view::npos;
}

// `cycle.x`, where it is a measure; "" else.
std::string measureOf(const fusion::Node* node) {
  const std::string name = fusion::dotted(fusion::bare(node));
  return name.starts_with("cycle.") && isMeasure(name.substr(6)) ? name : "";
}

// `cycle.x || 90`, `!cycle.x ? 90 : cycle.x`, `if (!cycle.x) { a = 90; }`.
void checkForms(const Project& project, Report& report) {
  const auto say = [&](const PostFile& post, const fusion::Node* tested, const fusion::Node* number) {
    report.at(
        post.tree.range(*fusion::bare(tested)),
        "a value of 0 counts as missing here, and {} takes its place; `{} !== undefined` asks whether it "
        "is there",
        fusion::bare(number)->text, measureOf(tested));
  };
  const auto negated = [](const fusion::Node* test) -> const fusion::Node* {
    test = fusion::bare(test);
    return test->is(fusion::Kind::Unary) && test->text == "!" ? test->kids[0] : nullptr;
  };
  forEachPost(project, [&](const PostFile& post) {
    for (const fusion::Node& node : post.tree.nodes) {
      if (node.is(fusion::Kind::Binary) && node.text == "||") {
        if (!measureOf(node.kids[0]).empty() && isOther(node.kids[1])) say(post, node.kids[0], node.kids[1]);
      } else if (node.is(fusion::Kind::Conditional)) {
        const fusion::Node* const tested = negated(node.kids[0]);
        if (tested != nullptr && !measureOf(tested).empty() && isOther(node.kids[1]))
          say(post, tested, node.kids[1]);
      } else if (node.is(fusion::Kind::If)) {
        const fusion::Node* const tested = negated(node.kids[0]);
        if (tested == nullptr || measureOf(tested).empty()) continue;
        const fusion::Node* number = nullptr;
        walk(node.kids[1], [&](const fusion::Node& part) {
          if (part.is(fusion::Kind::Assign) && part.text == "=" && isOther(part.kids[1]))
            number = part.kids[1];
        });
        if (number != nullptr) say(post, tested, number);
      }
    }
  });
}

void check(const Project& project, Report& report) {
  checkForms(project, report);
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
