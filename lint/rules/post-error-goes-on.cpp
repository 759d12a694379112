#include "lint/Posts.h"

#include <algorithm>
#include <fmt/format.h>

namespace dotek::lint::rule {
namespace {

bool writes(const fusion::Node* statement) {
  bool out = false;
  walk(statement, [&](const fusion::Node& node) {
    if (!node.is(fusion::Kind::Call)) return;
    const std::string name = calledName(node);
    out = out || name == "writeBlock" || name == "writeln" || name == "writeWords" || name == "writeComment";
  });
  return out;
}

// `if (..) { error(..); }`: the calls that end a branch.
void endsOf(const fusion::Node* statement, std::vector<const fusion::Node*>& out) {
  if (statement == nullptr) return;
  if (statement->is(fusion::Kind::Block)) {
    if (!statement->kids.empty()) endsOf(statement->kids.back(), out);
  } else if (statement->is(fusion::Kind::If)) {
    endsOf(statement->kid(1), out);
    endsOf(statement->kid(2), out);
  } else if (statement->is(fusion::Kind::Evaluate) && statement->kids[0]->is(fusion::Kind::Call) &&
             calledName(*statement->kids[0]) == "error") {
    out.push_back(statement->kids[0]->kids[0]);
  }
}

void check(const Project& project, Report& report) {
  forEachPost(project, [&](const PostFile& post) {
    std::vector<const fusion::Node*> guards; // errors of a branch, after which the function writes on
    const auto judgeBranches = [&](const std::vector<fusion::Node*>& body, std::size_t first) {
      bool later = false;
      for (std::size_t i = body.size(); i-- > first;) {
        if (body[i] == nullptr) continue;
        if (later && body[i]->is(fusion::Kind::If)) endsOf(body[i], guards);
        later = (later && !endsFlow(body[i])) || writes(body[i]);
      }
    };
    const auto judge = [&](const std::vector<fusion::Node*>& body, std::size_t first) {
      for (std::size_t i = first; i + 1 < body.size(); ++i) {
        const fusion::Node* const one = body[i];
        if (one == nullptr || !one->is(fusion::Kind::Evaluate) || !one->kids[0]->is(fusion::Kind::Call))
          continue;
        if (calledName(*one->kids[0]) != "error") continue;
        const fusion::Node* const next = body[i + 1];
        if (!writes(next)) continue;
        report.at(post.tree.range(*one->kids[0]->kids[0]),
                  "blocks are written after this error: whether the engine stops at it is not stated");
      }
    };
    for (const fusion::Node& node : post.tree.nodes) {
      if (!node.is(fusion::Kind::Block) && !node.is(fusion::Kind::Case)) continue;
      judge(node.kids, node.is(fusion::Kind::Case) ? 1 : 0);
      judgeBranches(node.kids, node.is(fusion::Kind::Case) ? 1 : 0);
    }
    if (guards.empty()) return;
    // A habit of its author: one finding for a post.
    const auto least = std::min_element(guards.begin(), guards.end(),
                                        [](const auto* a, const auto* b) { return a->begin < b->begin; });
    const std::string more =
        guards.size() == 1 ? "" : fmt::format(" (as after {} others of this post)", guards.size() - 1);
    report.at(post.tree.range(**least),
              "the function goes on after this error and writes blocks{}: whether the engine stops at it is "
              "not stated",
              more);
  });
}

} // namespace

DOTEK_LINT_RULE(post_error_goes_on){
    .severity = Severity::Note,
    .check = check,
};

} // namespace dotek::lint::rule
