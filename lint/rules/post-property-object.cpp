#include "lint/Posts.h"

#include <map>

namespace dotek::lint::rule {
namespace {

// What takes the value of a part: a condition, an operator.
bool isTested(const fusion::Node& above, const fusion::Node& part) {
  switch (above.kind) {
  case fusion::Kind::If:
  case fusion::Kind::While:
  case fusion::Kind::Conditional: return fusion::bare(above.kids[0]) == &part;
  case fusion::Kind::Unary: return above.text == "!" || above.text == "-" || above.text == "+";
  case fusion::Kind::Binary: return above.text != "instanceof" && above.text != "in" && above.text != "?\?";
  case fusion::Kind::Switch: return above.kids[0] == &part;
  default: return false;
  }
}

void check(const Project& project, Report& report) {
  forEachPost(project, [&](const PostFile& post) {
    const fusion::Node* const all = fusion::bare(topLevelValue(post, "properties"));
    if (all == nullptr || !all->is(fusion::Kind::Object)) return;
    std::map<const fusion::Node*, const fusion::Node*> parents;
    for (const fusion::Node& node : post.tree.nodes)
      for (const fusion::Node* kid : node.kids)
        if (kid != nullptr) parents[kid] = &node;
    for (const fusion::Node& node : post.tree.nodes) {
      if (!node.is(fusion::Kind::Member) || !node.kids[0]->isName("properties")) continue;
      const fusion::Node* const value = fusion::bare(propertyOf(all, node.kids[1]->text));
      if (value == nullptr || !value->is(fusion::Kind::Object) || propertyOf(value, "value") == nullptr)
        continue;
      const fusion::Node* above = parents[&node];
      while (above != nullptr && above->is(fusion::Kind::Brackets))
        above = parents[above];
      if (above == nullptr || !isTested(*above, node)) continue;
      report.at(post.tree.range(node),
                "`properties.{0}` is the definition of the property, which is never false; its value is "
                "getProperty(\"{0}\")",
                node.kids[1]->text);
    }
  });
}

} // namespace

DOTEK_LINT_RULE(post_property_object){
    .severity = Severity::Warning,
    .check = check,
};

} // namespace dotek::lint::rule
