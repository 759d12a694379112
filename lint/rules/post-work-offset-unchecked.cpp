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
constexpr double kFewest = 5; // of the whole post; one of fewer has to enclose the block

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

// `offset == 0`, `offset < 1`, `!offset`.
template <class Test> bool asksForZero(const Node& node, const Test& isOffset) {
  if (node.is(Kind::Unary) && node.text == "!") return isOffset(node.kids[0]);
  if (!node.is(Kind::Binary) || node.text.find_first_of("=<>!") == std::string_view::npos) return false;
  for (const std::size_t side : {0U, 1U}) {
    const Node* const number = fusion::bare(node.kids[side]);
    if (number != nullptr && number->is(Kind::Number) && (number->text == "0" || number->text == "1") &&
        isOffset(node.kids[1 - side]))
      return true;
  }
  return false;
}

void check(const Project& project, Report& report) {
  forEachPost(project, [&](const PostFile& post) {
    const std::set<std::string> names = holders(post);
    const auto isOffset = [&](const Node* node) {
      const std::string name = fusion::dotted(fusion::bare(node));
      return name.ends_with(kOffset) || names.contains(name);
    };
    // The number that an offset is compared with; `above`: where the comparison holds the offset is above it.
    const auto boundOf = [&](const Node& node, bool& above) -> double {
      if (!node.is(Kind::Binary) || (!node.text.starts_with('<') && !node.text.starts_with('>'))) return 0;
      const bool left = isOffset(node.kids[0]);
      if (!left && !isOffset(node.kids[1])) return 0;
      const Node* const number = fusion::bare(node.kids[left ? 1 : 0]);
      if (number == nullptr || !number->is(Kind::Number)) return 0;
      above = node.text.starts_with('>') == left;
      const bool equal = node.text.size() > 1;
      return std::atof(std::string(number->text).c_str()) - (above == equal ? 1 : 0);
    };
    bool bounded = false, zero = false;
    for (const Node& node : post.tree.nodes) {
      bool above = false;
      bounded = bounded || boundOf(node, above) >= kFewest;
      zero = zero || asksForZero(node, isOffset);
    }
    if (bounded) return;
    // A branch that only offsets up to a lower bound reach: the others have one of their own.
    const auto inBranch = [&](const Node& sum) {
      return std::any_of(post.tree.nodes.begin(), post.tree.nodes.end(), [&](const Node& node) {
        if (!node.is(Kind::If) && !node.is(Kind::Conditional)) return false;
        bool above = false;
        if (boundOf(*fusion::bare(node.kids[0]), above) < 1) return false;
        const Node* const branch = node.kid(above ? 2 : 1);
        if (branch != nullptr && branch->begin <= sum.begin && sum.end <= branch->end) return true;
        return above && node.is(Kind::If) && sum.begin >= node.end && endsFlow(node.kids[1]);
      });
    };
    for (const Node& call : post.tree.nodes) {
      if (!call.is(Kind::Call) || call.kids.size() != 2 || !calledName(call).ends_with(".format")) continue;
      const Node* const sum = fusion::bare(call.kids[1]);
      if (sum == nullptr || !sum->is(Kind::Binary) || sum->text != "+") continue;
      for (const std::size_t side : {0U, 1U}) {
        const Node* const number = fusion::bare(sum->kids[side]);
        if (number == nullptr || !number->is(Kind::Number) || number->text != "53") continue;
        if (!isOffset(sum->kids[1 - side]) || inBranch(*sum)) continue;
        if (zero)
          report.at(post.tree.range(*sum),
                    "nothing in the post asks whether the work offset is above 6: 7 prints G60");
        else
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
