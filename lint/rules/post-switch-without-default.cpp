#include "lint/PostEntries.h"

#include <algorithm>

namespace dotek::lint::rule {
namespace {

// Directly in onCyclePoint or onCommand: elsewhere a switch may only choose.
bool inEntry(const PostFile& post, const fusion::Node& node) {
  for (const TopFunction& one : topFunctions(post.tree)) {
    if (one.function->begin > node.begin || one.function->end < node.end) continue;
    if (one.name->text != "onCyclePoint" && one.name->text != "onCommand") return false;
    // Something after it that ends or goes on with the rest.
    const auto& body = one.body()->kids;
    return one.body()->is(fusion::Kind::Block) && !body.empty() && body.back() == &node;
  }
  return false;
}

// In onCyclePoint: the variable that each case of a switch gives a value, that has none before, and that what
// follows the switch reads.
std::string leftOpen(const PostFile& post, const fusion::Node& node) {
  std::string out;
  for (std::size_t i = 1; i < node.kids.size(); ++i) {
    const fusion::Node& one = *node.kids[i];
    if (one.kids.size() < 2) continue;
    std::string given;
    for (std::size_t k = 1; k < one.kids.size(); ++k)
      if (const fusion::Node* const value = one.kids[k]->kid(0);
          one.kids[k]->is(fusion::Kind::Evaluate) && value->is(fusion::Kind::Assign) && value->text == "=" &&
          value->kids[0]->is(fusion::Kind::Name))
        given = value->kids[0]->text;
    if (given.empty() || (!out.empty() && given != out)) return "";
    out = given;
  }
  for (const fusion::Symbol& symbol : post.scopes.symbols) {
    if (symbol.name != out || symbol.kind == fusion::Symbol::Kind::Parameter || symbol.value != nullptr ||
        symbol.scope->function->node == nullptr)
      continue;
    const fusion::Node& function = *symbol.scope->function->node;
    if (node.begin < function.begin || node.end > function.end) continue;
    const std::vector<TopFunction> top = topFunctions(post.tree);
    if (std::none_of(top.begin(), top.end(), [&](const TopFunction& one) {
          return one.function == &function && one.name->text == "onCyclePoint";
        }))
      continue;
    bool before = false, after = false;
    for (const fusion::Use& use : post.scopes.uses) {
      if (use.symbol != &symbol) continue;
      before = before || (use.name->begin < node.begin && use.kind != fusion::Use::Kind::Read);
      after = after || (use.name->begin > node.end && use.kind == fusion::Use::Kind::Read);
    }
    if (!before && after) return out;
  }
  return "";
}

void check(const Project& project, Report& report) {
  forEachNode(project, fusion::Kind::Switch, [&](const PostFile& post, const fusion::Node& node) {
    const std::string name = fusion::dotted(fusion::bare(node.kids[0]));
    if (name != "cycleType" && name != "command") return;
    std::size_t real = 0;
    for (std::size_t i = 1; i < node.kids.size(); ++i) {
      if (node.kids[i]->kids[0] == nullptr) return;
      real += node.kids[i]->kids.size() > 1 ? 1 : 0;
    }
    if (const std::string open = name == "cycleType" && real >= 2 ? leftOpen(post, node) : "";
        !open.empty()) {
      report.at(
          {post.file, node.begin, node.begin + 6},
          "this switch of `cycleType` has no default: of a cycle that it does not name `{}` has no value",
          open);
      return;
    }
    if (real < 3 || !inEntry(post, node)) return;
    report.at({post.file, node.begin, node.begin + 6},
              "this switch of `{}` has no default: a {} that it does not name is passed over in silence",
              name, name == "command" ? "command" : "cycle");
  });
}

} // namespace

DOTEK_LINT_RULE(post_switch_without_default){
    .severity = Severity::Note,
    .check = check,
};

} // namespace dotek::lint::rule
