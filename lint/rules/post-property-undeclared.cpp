#include "lint/Posts.h"
#include "support/NearestName.h"

#include <set>

namespace dotek::lint::rule {
namespace {

void check(const Project& project, Report& report) {
  forEachPost(project, [&](const PostFile& post) {
    const fusion::Node* const all = fusion::bare(topLevelValue(post, "properties"));
    if (all == nullptr || !all->is(fusion::Kind::Object)) return;
    std::set<std::string_view> declared;
    for (const fusion::Node* one : all->kids) {
      if (!one->is(fusion::Kind::Property) || one->kids[0]->is(fusion::Kind::Computed))
        return; // computed: not known
      declared.insert(keyOf(*one));
    }
    for (const fusion::Node& node : post.tree.nodes) // given in code
      if (node.is(fusion::Kind::Assign) && node.kids[0]->is(fusion::Kind::Member) &&
          node.kids[0]->kids[0]->isName("properties"))
        declared.insert(node.kids[0]->kids[1]->text);
    // A post that asks whether a property is there knows that it may not be.
    for (const fusion::Node& node : post.tree.nodes) {
      if (!node.is(fusion::Kind::Binary) || node.text.find('=') == std::string_view::npos) continue;
      const fusion::Node* const asked = fusion::bare(node.kids[0]);
      if (!fusion::bare(node.kids[1])->isName("undefined")) continue;
      if (asked->is(fusion::Kind::Call) && calledName(*asked) == "getProperty")
        declared.insert(textLiteral(asked->kid(1)));
      if (asked->is(fusion::Kind::Member) && asked->kids[0]->isName("properties"))
        declared.insert(asked->kids[1]->text);
    }
    const std::set<std::string_view> known = declared; // each name is reported once
    const auto judge = [&](std::string_view name, const fusion::Node& where) {
      if (name.empty() || !declared.insert(name).second) return;
      const std::string near = nearestName(name, known);
      report.at(post.tree.range(where), "the post declares no property `{}`: what is read is undefined{}",
                name, near.empty() ? "" : "; did you mean `" + near + "`?");
    };
    for (const fusion::Node& node : post.tree.nodes) {
      if (node.is(fusion::Kind::Member) && node.kids[0]->isName("properties"))
        judge(node.kids[1]->text, *node.kids[1]);
      const std::string called = node.is(fusion::Kind::Call) ? calledName(node) : "";
      if ((called == "getProperty" || called == "currentSection.getProperty" ||
           called == "section.getProperty") &&
          node.kids.size() == 2)
        judge(textLiteral(node.kids[1]), *node.kids[1]);
    }
  });
}

} // namespace

DOTEK_LINT_RULE(post_property_undeclared){
    .severity = Severity::Warning,
    .check = check,
};

} // namespace dotek::lint::rule
