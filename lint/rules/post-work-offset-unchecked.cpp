#include "lint/Posts.h"

#include <algorithm>
#include <cstdlib>
#include <set>
#include <string>

namespace dotek::lint::rule {
namespace {

using fusion::Kind;
using fusion::Node;

constexpr std::string_view kOffset = ".workOffset";
constexpr double kFewest = 5; // a bound of fewer is no bound of six work offsets

// Names that hold the work offset of a section.
std::set<std::string> holders(const PostFile& post) {
  std::set<std::string> out;
  for (const Node& node : post.tree.nodes) {
    if (!node.is(Kind::Declarator) && !node.is(Kind::Assign)) continue;
    const Node* const value = fusion::bare(node.kid(1));
    const Node* const target = fusion::bare(node.kid(0));
    if (value == nullptr || target == nullptr || !fusion::dotted(value).ends_with(kOffset)) continue;
    if (const std::string name = fusion::dotted(target); !name.empty()) out.insert(name);
  }
  return out;
}

void check(const Project& project, Report& report) {
  forEachPost(project, [&](const PostFile& post) {
    const std::set<std::string> names = holders(post);
    const auto isOffset = [&](const Node* node) {
      const std::string name = fusion::dotted(fusion::bare(node));
      return name.ends_with(kOffset) || names.contains(name);
    };
    const auto isBound = [](const Node* node) {
      node = fusion::bare(node);
      return node != nullptr && node->is(Kind::Number) &&
             std::atof(std::string(node->text).c_str()) >= kFewest;
    };
    const bool bounded = std::any_of(post.tree.nodes.begin(), post.tree.nodes.end(), [&](const Node& node) {
      if (!node.is(Kind::Binary) || (!node.text.starts_with('<') && !node.text.starts_with('>')))
        return false;
      return (isOffset(node.kids[0]) && isBound(node.kids[1])) ||
             (isBound(node.kids[0]) && isOffset(node.kids[1]));
    });
    if (bounded) return;
    for (const Node& call : post.tree.nodes) {
      if (!call.is(Kind::Call) || call.kids.size() != 2 || !calledName(call).ends_with(".format")) continue;
      const Node* const sum = fusion::bare(call.kids[1]);
      if (sum == nullptr || !sum->is(Kind::Binary) || sum->text != "+") continue;
      for (const std::size_t side : {0U, 1U}) {
        const Node* const number = fusion::bare(sum->kids[side]);
        if (number == nullptr || !number->is(Kind::Number) || number->text != "53") continue;
        if (!isOffset(sum->kids[1 - side])) continue;
        report.at(
            post.tree.range(*sum),
            "nothing in the post asks whether the work offset is one of 1 to 6: 0, of a setup that names "
            "none, prints G53, the coordinates of the machine, and 7 prints G60");
      }
    }
  });
}

} // namespace

DOTEK_LINT_RULE(post_work_offset_unchecked){
    .severity = Severity::Warning,
    .check = check,
};

} // namespace dotek::lint::rule
