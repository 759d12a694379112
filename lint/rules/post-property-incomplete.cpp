#include "lint/Posts.h"

#include <algorithm>
#include <array>
#include <set>
#include <vector>

namespace dotek::lint::rule {
namespace {

// Groups that the dialog has of its own.
bool isBuiltIn(std::string_view group) {
  constexpr auto kGroups = std::to_array<std::string_view>(
      {"general", "preferences", "formats", "configuration", "homePositions", "multiAxis", "toolChange",
       "coolant", "probing", "inspection", "basic", "advanced", "safety", "tooling"});
  return std::find(kGroups.begin(), kGroups.end(), group) != kGroups.end();
}

// Where most properties have a group, those that have none.
void checkGroups(const PostFile& post, const fusion::Node& all, Report& report) {
  std::vector<const fusion::Node*> without;
  std::size_t with = 0;
  for (const fusion::Node* one : all.kids) {
    if (!one->is(fusion::Kind::Property)) continue;
    const fusion::Node* const value = fusion::bare(one->kids[1]);
    if (!value->is(fusion::Kind::Object) || propertyOf(value, "title") == nullptr) continue;
    if (propertyOf(value, "group") != nullptr)
      ++with;
    else if (propertyOf(value, "visible") == nullptr)
      without.push_back(one);
  }
  if (with < 2 || with <= without.size()) return;
  for (const fusion::Node* one : without)
    report.at(
        post.tree.range(*one->kids[0]),
        "the property `{}` has no `group`, as {} others of the post have: the dialog shows it apart from "
        "them",
        keyOf(*one), with);
}

void check(const Project& project, Report& report) {
  forEachPost(project, [&](const PostFile& post) {
    const fusion::Node* const all = fusion::bare(topLevelValue(post, "properties"));
    if (all == nullptr || !all->is(fusion::Kind::Object)) return;
    checkGroups(post, *all, report);
    std::set<std::string_view> told; // groups
    const fusion::Node* const groups = fusion::bare(topLevelValue(post, "groupDefinitions"));
    for (const fusion::Node* one : all->kids) {
      if (!one->is(fusion::Kind::Property)) continue;
      const fusion::Node* const value = fusion::bare(one->kids[1]);
      if (!value->is(fusion::Kind::Object) || propertyOf(value, "title") == nullptr) continue;
      for (const char* const part : {"type", "value"})
        if (propertyOf(value, part) == nullptr &&
            propertyOf(value, std::string("default_") + "mm") == nullptr)
          report.at(post.tree.range(*one->kids[0]), "the property `{}` has no `{}`", keyOf(*one), part);
      const std::string_view group = textLiteral(propertyOf(value, "group"));
      if (groups != nullptr && groups->is(fusion::Kind::Object) && !group.empty() &&
          propertyOf(groups, group) == nullptr && !isBuiltIn(group) && told.insert(group).second)
        report.at(post.tree.range(*propertyOf(value, "group")),
                  "the group `{}` is not in groupDefinitions: the dialog shows its id", group);
      const fusion::Node* const values = fusion::bare(propertyOf(value, "values"));
      const std::string_view chosen = textLiteral(propertyOf(value, "value"));
      if (values == nullptr || !values->is(fusion::Kind::Array) || chosen.empty()) continue;
      bool known = false, plain = true;
      for (const fusion::Node* each : values->kids) {
        const fusion::Node* id = fusion::bare(each);
        if (id != nullptr && id->is(fusion::Kind::Object)) id = fusion::bare(propertyOf(id, "id"));
        plain = plain && id != nullptr && id->is(fusion::Kind::String);
        known = known || textLiteral(id) == chosen;
      }
      if (plain && !known)
        report.at(post.tree.range(*propertyOf(value, "value")),
                  "the value `{}` of the property `{}` is none of its `values`", chosen, keyOf(*one));
    }
  });
}

} // namespace

DOTEK_LINT_RULE(post_property_incomplete){
    .severity = Severity::Note,
    .check = check,
};

} // namespace dotek::lint::rule
