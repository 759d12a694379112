#include "lint/Posts.h"

#include <algorithm>

namespace dotek::lint::rule {
namespace {

using fusion::Kind;
using fusion::Node;

bool inside(const Node& inner, const Node* outer) {
  return outer != nullptr && outer->begin <= inner.begin && inner.end <= outer->end;
}

// A call that writes the code: "G49", gFormat.format(49).
bool writesCode(const Node& call, std::string_view number) {
  const std::string name = call.is(Kind::Call) ? calledName(call) : "";
  if (name.ends_with(".format"))
    return call.kids.size() == 2 && fusion::bare(call.kids[1])->is(Kind::Number) &&
           fusion::bare(call.kids[1])->text == number;
  if (name != "writeBlock" && name != "writeln" && name != "writeWords") return false;
  return std::any_of(call.kids.begin() + 1, call.kids.end(), [&](const Node* one) {
    const std::string_view text = textLiteral(one);
    const std::string code = "G" + std::string(number);
    return text == code || text.starts_with(code + " ");
  });
}

bool asksForProbe(const Node* test) {
  bool out = false;
  walk(test, [&](const Node& part) {
    const std::string name = part.is(Kind::Call) ? calledName(part) : "";
    out = out || name == "isProbeOperation" || name == "isProbingCycle" || textLiteral(&part) == "probe" ||
          part.isName("TOOL_PROBE");
  });
  return out;
}

// The whole condition is that the tool changes: `insertToolCall`, or the question itself.
bool asksForChange(const PostFile& post, const Node* test) {
  test = fusion::bare(test);
  if (test->is(Kind::Name)) {
    const fusion::Symbol* const symbol = post.scopes.symbolOf(test);
    if (symbol == nullptr || symbol->value == nullptr) return false;
    bool asks = false;
    walk(symbol->value, [&](const Node& part) {
      asks = asks || (part.is(Kind::Call) && calledName(part) == "isToolChangeNeeded") ||
             (part.is(Kind::Member) && part.kids[1]->text == "getForceToolChange") ||
             fusion::dotted(&part) == "tool.number";
    });
    const bool once =
        std::none_of(post.scopes.uses.begin(), post.scopes.uses.end(), [&](const fusion::Use& use) {
          return use.symbol == symbol && use.kind != fusion::Use::Kind::Read && use.value != symbol->value;
        });
    return asks && once;
  }
  return test->is(Kind::Call) && calledName(*test) == "isToolChangeNeeded";
}

void check(const Project& project, Report& report) {
  forEachPost(project, [&](const PostFile& post) {
    std::vector<const Node*> cancels, calls;
    for (const Node& node : post.tree.nodes) {
      if (writesCode(node, "49")) cancels.push_back(&node);
      if (writesCode(node, "43") || writesCode(node, "234") || writesCode(node, "43.4"))
        calls.push_back(&node);
    }
    if (cancels.empty() || calls.empty()) return;
    const auto within = [&](const Node& node, const auto& test) {
      return std::any_of(post.tree.nodes.begin(), post.tree.nodes.end(), [&](const Node& one) {
        return (one.is(Kind::If) || one.is(Kind::Conditional)) && inside(node, one.kids[1]) &&
               test(one.kids[0]);
      });
    };
    // One that is not bound to a change of the tool may follow the probe: nothing is known then.
    for (const Node* one : calls)
      if (!within(*one, [&](const Node* test) { return asksForChange(post, test); })) return;
    for (const Node* one : cancels)
      if (within(*one, asksForProbe) &&
          !within(*one, [&](const Node* test) { return asksForChange(post, test); }))
        report.at(
            post.tree.range(*one),
            "the length is cancelled after the probe, and G43 is only written with a change of the tool: the "
            "next operation of the same tool moves without its length");
  });
}

} // namespace

DOTEK_LINT_RULE(post_length_not_called){
    .severity = Severity::Warning,
    .check = check,
};

} // namespace dotek::lint::rule
