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

// `getProperty("x") || 5` of a property that is a number and begins with another than 0: it is always there.
void checkProperties(const Project& project, Report& report) {
  forEachPost(project, [&](const PostFile& post) {
    const fusion::Node* const all = fusion::bare(topLevelValue(post, "properties"));
    if (all == nullptr || !all->is(fusion::Kind::Object)) return;
    for (const fusion::Node& node : post.tree.nodes) {
      if (!node.is(fusion::Kind::Binary) || node.text != "||" || !isOther(node.kids[1])) continue;
      const fusion::Node* const asked = fusion::bare(node.kids[0]);
      if (!asked->is(fusion::Kind::Call) || calledName(*asked) != "getProperty" || asked->kids.size() != 2)
        continue;
      const std::string_view name = textLiteral(asked->kids[1]);
      const fusion::Node* const property = name.empty() ? nullptr : fusion::bare(propertyOf(all, name));
      if (property == nullptr || !property->is(fusion::Kind::Object) ||
          !isOther(propertyOf(property, "value")))
        continue;
      report.at(post.tree.range(*asked),
                "who sets the property `{}` to 0 gets {}: 0 counts as missing here, and a property is always "
                "there; leave the second value out",
                name, fusion::bare(node.kids[1])->text);
    }
  });
}

void check(const Project& project, Report& report) {
  checkForms(project, report);
  checkProperties(project, report);
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
