#include "lint/Posts.h"

namespace dotek::lint::rule {
namespace {

bool remarks(const PostFile& post, std::uint32_t from, std::uint32_t to) {
  for (const fusion::Comment& one : post.tree.tokens.comments)
    if (one.range.begin >= from && one.range.end <= to) return true;
  return false;
}

void check(const Project& project, Report& report) {
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
