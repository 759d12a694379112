#include "lint/Posts.h"

namespace dotek::lint::rule {
namespace {

bool remarks(const PostFile& post, std::uint32_t from, std::uint32_t to) {
  for (const fusion::Comment& one : post.tree.tokens.comments)
    if (one.range.begin >= from && one.range.end <= to) return true;
  return false;
}

// The variable that a statement gives a value, which its own value does not read.
std::string givenBy(const fusion::Node* statement) {
  if (statement == nullptr || !statement->is(fusion::Kind::Evaluate)) return "";
  const fusion::Node* const value = statement->kids[0];
  if (!value->is(fusion::Kind::Assign) || value->text != "=") return "";
  const std::string name = fusion::dotted(value->kids[0]);
  bool reads = false;
  walk(value->kids[1], [&](const fusion::Node& part) { reads = reads || fusion::dotted(&part) == name; });
  return reads ? "" : name;
}

void check(const Project& project, Report& report) {
  forEachNode(project, fusion::Kind::Switch, [&](const PostFile& post, const fusion::Node& node) {
    for (std::size_t i = 1; i + 1 < node.kids.size(); ++i) {
      const fusion::Node& one = *node.kids[i];
      const fusion::Node& next = *node.kids[i + 1];
      if (one.kids.size() < 2 || next.kids.size() < 2) continue;
      const std::string name = givenBy(one.kids.back());
      if (!name.empty() && name == givenBy(next.kids[1]) && !remarks(post, one.kids.back()->end, next.begin))
        report.at(
            post.tree.range(*one.kids.back()),
            "`{}` has this value in no case: the next case follows without `break` and gives it another",
            name);
    }
  });
  forEachNode(project, fusion::Kind::Switch, [&](const PostFile& post, const fusion::Node& node) {
    for (std::size_t i = 1; i + 1 < node.kids.size(); ++i) {
      const fusion::Node& one = *node.kids[i];
      if (one.kids.size() < 2 || endsFlow(one.kids.back())) continue;
      bool writes = false;
      for (std::size_t k = 1; k < one.kids.size(); ++k)
        walk(one.kids[k], [&](const fusion::Node& part) {
          const std::string name = part.is(fusion::Kind::Call) ? calledName(part) : "";
          writes = writes || name == "writeBlock" || name == "writeln" || name == "writeComment";
        });
      const fusion::Node& next = *node.kids[i + 1];
      if (!writes || next.kids.size() < 2 || remarks(post, one.kids.back()->end, next.begin)) continue;
      report.at(
          post.tree.range(*one.kids.back()),
          "the block is written, and the next case follows without `break`: its blocks are written, too");
    }
  });
}

} // namespace

DOTEK_LINT_RULE(post_case_falls_through){
    .severity = Severity::Warning,
    .check = check,
};

} // namespace dotek::lint::rule
