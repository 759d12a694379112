#include "lint/Posts.h"
#include "support/NearestName.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>
#include <vector>

namespace dotek::lint::rule {
namespace {

// `typeof f == "function"` of a function that neither the post nor the engine has: never true.
bool asksForMissing(const PostFile& post, const fusion::Node* node) {
  node = fusion::bare(node);
  if (!node->is(fusion::Kind::Binary)) return false;
  if (node->text == "&&") return asksForMissing(post, node->kids[0]) || asksForMissing(post, node->kids[1]);
  const fusion::Node* const asked = fusion::bare(node->kids[0]);
  if ((node->text != "==" && node->text != "===") || !asked->is(fusion::Kind::Unary) ||
      asked->text != "typeof" || textLiteral(node->kids[1]) != "function")
    return false;
  const fusion::Node* const name = fusion::bare(asked->kids[0]);
  if (!name->is(fusion::Kind::Name) || post.names->all.contains(name->text)) return false;
  const auto& own = post.scopes.scopes.front().names;
  const auto found = own.find(name->text);
  return found == own.end() || found->second->kind == fusion::Symbol::Kind::Global;
}

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
    std::set<const fusion::Node*> never; // reads that come with a function that is not there
    for (const fusion::Node& node : post.tree.nodes)
      if (node.is(fusion::Kind::Binary) && node.text == "&&" && asksForMissing(post, &node))
        walk(&node, [&](const fusion::Node& one) { never.insert(&one); });
    const std::set<std::string_view> known = declared; // each name is reported once
    std::vector<const fusion::Node*> plain;            // names that are no misspelt ones: one finding
    const auto judge = [&](std::string_view name, const fusion::Node& where) {
      if (name.empty() || never.contains(&where) || !declared.insert(name).second) return;
      const std::string near = nearestName(name, known);
      if (near.empty())
        plain.push_back(&where);
      else
        report.at(post.tree.range(where),
                  "the post declares no property `{}`: what is read is undefined; did you mean `{}`?", name,
                  near);
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
    if (plain.empty()) return;
    std::sort(plain.begin(), plain.end(), [](const auto* a, const auto* b) { return a->begin < b->begin; });
    const auto nameOf = [](const fusion::Node& node) {
      return node.is(fusion::Kind::Name) ? node.text : textLiteral(&node);
    };
    Diagnostic& found =
        report.at(post.tree.range(*plain.front()),
                  "the post declares no property `{}`: what is read is undefined", nameOf(*plain.front()));
    for (std::size_t i = 1; i < plain.size(); ++i)
      found.note(post.tree.range(*plain[i]), fmt::format("nor `{}`", nameOf(*plain[i])));
  });
}

} // namespace

DOTEK_LINT_RULE(post_property_undeclared){
    .severity = Severity::Warning,
    .check = check,
};

} // namespace dotek::lint::rule
