// Loops whose variables a function keeps: each pass becomes a call, so that it has variables of its own.
#include "frontend/fusion/Lowering.h"

#include <algorithm>
#include <fmt/format.h>

namespace dotek::frontend::fusion {

namespace {

bool isLoop(const Node& node) {
  return node.is(Kind::For) || node.is(Kind::ForIn) || node.is(Kind::ForOf) || node.is(Kind::While) ||
         node.is(Kind::DoWhile);
}

bool within(const Node& node, const Node& part) {
  return part.begin >= node.begin && part.end <= node.end;
}

} // namespace

const Node* Lowering::bodyOf(const Node& loop) {
  return loop.kids[loop.is(Kind::For) ? 3 : loop.is(Kind::While) ? 1 : loop.is(Kind::DoWhile) ? 0 : 2];
}

// The loop that makes a variable anew in each pass.
const Node* Lowering::loopOf(const Symbol& symbol) const {
  for (const Scope* at = symbol.scope; at != nullptr && at->node != nullptr && at != at->function;
       at = at->parent) {
    if (isLoop(*at->node)) return at->node;
    for (const Node& node : tree_.nodes)
      if ((node.is(Kind::While) || node.is(Kind::DoWhile)) && bodyOf(node) == at->node) return &node;
  }
  return nullptr;
}

// Why a pass cannot be a call; "": it can.
std::string Lowering::noCall(const Node& loop, const Use& use) const {
  const Node& body = *bodyOf(loop);
  if (!within(body, *use.name)) return "in the head of the loop";
  for (const Scope* at = use.symbol->scope; at != nullptr; at = at->parent)
    if (at == at->function && at->parent != nullptr && at->usesArguments) return "beside `arguments`";
  for (const Symbol& symbol : scopes_.symbols) {
    if (symbol.kind != Symbol::Kind::Function || symbol.declaration == nullptr ||
        !within(body, *symbol.declaration) || symbol.scope != use.symbol->scope->function)
      continue;
    for (const Use& other : scopes_.uses)
      if (other.symbol == &symbol && !within(body, *other.name))
        return fmt::format("beside the function `{}`, which is called outside of the loop", symbol.name);
  }
  return "";
}

void Lowering::findPasses() {
  for (const Use& use : scopes_.uses) {
    const Symbol& symbol = *use.symbol;
    const bool caught = symbol.kind == Symbol::Kind::Catch && !symbol.scope->node->kids[0]->is(Kind::Name);
    if (symbol.kind != Symbol::Kind::Let && symbol.kind != Symbol::Kind::Const &&
        symbol.kind != Symbol::Kind::Class && !caught)
      continue;
    if (!symbol.scope->inLoop || use.scope->function == symbol.scope->function) continue;
    const Node* const loop = loopOf(symbol);
    if (loop == nullptr || passes_.contains(loop)) continue;
    const std::string reason = noCall(*loop, use);
    if (reason.empty()) {
      passes_.insert(loop);
    } else if (!staysInPass(use)) {
      refuse(*use.name,
             fmt::format("a function keeps `{0}`, which each pass of the loop makes anew, {1} (make it in a "
                         "function that takes `{0}` as its argument)",
                         symbol.name, reason));
    }
  }
  // Variables of the head have a name in it and another one in the pass.
  for (const Node* loop : passes_) {
    if (!loop->is(Kind::For)) continue;
    for (const auto& [name, symbol] : scopes_.ofNode.at(loop)->names) {
      renamed_.try_emplace(symbol, symbol->name);
      std::string inner;
      int count = 0;
      do
        inner = fmt::format("{}${}", name, ++count);
      while (!names_.insert(inner).second);
      inPass_[symbol] = inner;
    }
  }
}

// Jumps
// ---------------------------------------------------------------------------------------------------------

Lowering::Frame* Lowering::passAround() {
  for (std::size_t i = frames_.size(); i-- > 0;) {
    if (frames_[i].kind == Frame::Kind::Function) return nullptr;
    if (frames_[i].kind == Frame::Kind::Pass) return &frames_[i];
  }
  return nullptr;
}

// What `break` or `continue` becomes, without its end.
std::string Lowering::jump(const std::string& word, std::string_view label) {
  Frame* pass = nullptr; // the innermost that is left
  int crossed = 0;
  const std::string plain = word + (label.empty() ? "" : " " + std::string(label));
  for (std::size_t i = frames_.size(); i-- > 0;) {
    Frame& at = frames_[i];
    if (at.kind == Frame::Kind::Function) break;
    if (at.kind == Frame::Kind::Pass) {
      if (pass == nullptr) pass = &at;
      ++crossed;
      continue;
    }
    if (at.kind == Frame::Kind::Switch && word == "continue") continue;
    if (at.kind == Frame::Kind::Block && label.empty()) continue;
    if (!label.empty() && std::find(at.labels.begin(), at.labels.end(), label) == at.labels.end()) continue;
    const bool own =
        at.kind == Frame::Kind::Loop && crossed == 1 && frames_.size() > i + 1 && &frames_[i + 1] == pass;
    if (crossed == 0) return plain;
    if (own && word == "continue") return "return";
    if (own) {
      pass->leaves = true;
      return "return 1";
    }
    pass->jumps.insert({word, std::string(label)});
    return "return \"" + plain + "\"";
  }
  if (pass == nullptr) return plain; // to a label of a block
  pass->jumps.insert({word, std::string(label)});
  return "return \"" + plain + "\"";
}

std::string Lowering::leave(const Node& node) {
  if (!node.is(Kind::Return)) {
    const Node* const label = node.kid(0);
    const std::string word = node.is(Kind::Break) ? "break" : "continue";
    const std::uint32_t from =
        label == nullptr ? node.begin + static_cast<std::uint32_t>(word.size()) : label->end;
    return jump(word, label == nullptr ? "" : label->text) + slice(from, node.end);
  }
  Frame* const pass = passAround();
  const Node* const value = node.kid(0);
  if (pass == nullptr) return parts(node);
  pass->returns = true;
  if (value == nullptr) return "return []" + slice(node.begin + 6, node.end);
  return "return [" + lines(node.begin, value->begin) + of(value) + "]" + slice(value->end, node.end);
}

// Loops
// ---------------------------------------------------------------------------------------------------------

// The call of one pass: `first` comes before its statements, `last` after them, however they are left.
std::string Lowering::pass(const Node& body, const std::string& parameters, const std::string& given,
                           const std::string& first, const std::string& last) {
  frames_.push_back({Frame::Kind::Pass});
  const std::string text = body.is(Kind::Block) ? parts(body, body.begin + 1, body.end - 1) : of(&body);
  const Frame done = frames_.back();
  frames_.pop_back();
  const std::string code = ownName();
  std::string out = fmt::format(" var {} = (function ({}) {{ {}", code, parameters, first);
  out += last.empty() ? text : "try { " + text + " } finally { " + last + " }";
  out += " }).call(this" + (given.empty() ? "" : ", " + given) + ");";
  if (done.leaves) out += fmt::format(" if ({} === 1) {{ break; }}", code);
  for (const auto& [word, label] : done.jumps)
    out += fmt::format(" if ({} === \"{} {}\") {{ {}; }}", code, word, label, jump(word, label));
  if (done.returns) {
    Frame* const outer = passAround();
    if (outer != nullptr) outer->returns = true;
    out += fmt::format(" if (typeof {0} === \"object\") {{ return {0}{1}; }}", code,
                       outer == nullptr ? "[0]" : "");
  }
  return out;
}

std::string Lowering::forLoop(const Node& node) {
  const bool passes = passes_.contains(&node);
  const Node& body = *bodyOf(node);
  std::string out;
  std::uint32_t from = node.begin;
  for (std::size_t i = 0; i < 3; ++i) {
    const Node* const one = node.kids[i];
    if (one == nullptr) continue;
    out += slice(from, one->begin) + (one->is(Kind::Variables) ? variables(*one, true) : of(one));
    from = one->end;
  }
  out += slice(from, body.begin);
  if (!passes) return out + of(&body) + slice(body.end, node.end);
  std::string parameters, given, last;
  std::vector<std::pair<const Symbol*, std::string>> outer;
  for (const auto& [name, symbol] : scopes_.ofNode.at(&node)->names) {
    const std::string inner = inPass_.at(symbol);
    const std::string& head = renamed_.at(symbol);
    parameters += (parameters.empty() ? "" : ", ") + inner;
    given += (given.empty() ? "" : ", ") + head;
    const bool changed = std::any_of(scopes_.uses.begin(), scopes_.uses.end(), [&](const Use& use) {
      return use.symbol == symbol && within(body, *use.name) &&
             (use.kind == Use::Kind::Write || use.kind == Use::Kind::ReadWrite);
    });
    if (changed) last += fmt::format("{} = {}; ", head, inner);
    outer.emplace_back(symbol, head);
    renamed_[symbol] = inner;
  }
  const std::string text = pass(body, parameters, given, "", last);
  for (const auto& [symbol, name] : outer)
    renamed_[symbol] = name;
  return out + "{" + text + " }" + slice(body.end, node.end);
}

std::string Lowering::forIn(const Node& node) {
  const Node& first = *node.kids[0];
  const Node& body = *bodyOf(node);
  if (first.is(Kind::ArrayPattern) || first.is(Kind::ObjectPattern) ||
      (first.is(Kind::Variables) && !first.kids[0]->kids[0]->is(Kind::Name)))
    refuse(first, "a pattern in the head of `for (.. in ..)`");
  const bool passes = passes_.contains(&node);
  std::string name = of(first.is(Kind::Variables) ? first.kids[0]->kids[0] : &first);
  std::string head = name;
  if (first.is(Kind::Variables)) {
    if (first.text == "var" && passAround() != nullptr)
      hoist(name);
    else
      head = "var " + name;
  }
  const bool renews = passes && first.is(Kind::Variables) && first.text != "var";
  const std::string key = renews ? ownName() : "";
  if (renews) head = "var " + key;
  const std::string start =
      slice(node.begin, first.begin) + head + slice(first.end, node.kids[1]->begin) + of(node.kids[1]);
  if (!passes) return start + parts(node, node.kids[1]->end, node.end);
  return start + slice(node.kids[1]->end, body.begin) + "{" + pass(body, renews ? name : "", key, "", "") +
         " }" + slice(body.end, node.end);
}

std::string Lowering::forOf(const Node& node) {
  const Node& first = *node.kids[0];
  const Node& body = *node.kids[2];
  const std::string list = ownName();
  const std::string index = ownName();
  const bool declares = first.is(Kind::Variables);
  const bool hoisted = declares && first.text == "var" && passAround() != nullptr;
  const Node& target = declares ? *first.kids[0]->kids[0] : first;
  const std::string value = list + "[" + index + "]";
  std::vector<std::string> bound;
  std::string head;
  if (target.is(Kind::ArrayPattern) || target.is(Kind::ObjectPattern)) {
    const std::string one = declares && !hoisted ? ownName() : temporary();
    bound.push_back(one + " = " + value);
    bind(target, one, bound);
  } else {
    bound.push_back(of(&target) + " = " + value);
  }
  for (const std::string& one : bound)
    head += (head.empty() ? (declares && !hoisted ? "var " : "") : ", ") + one;
  if (hoisted) hoistAll(target);
  std::string out = fmt::format("for (var {0} = dotekEs6.list({1}), {2} = 0; {2} < {0}.length; ++{2}) {{",
                                list, of(node.kids[1]), index);
  out += lines(node.begin, node.kids[1]->begin);
  const std::string gap = lines(node.kids[1]->end, body.begin);
  if (passes_.contains(&node)) {
    const bool renews = declares && first.text != "var";
    return out + (renews ? "" : head + ";") + gap + pass(body, "", "", renews ? head + ";" : "", "") + " }";
  }
  out += head + ";" + gap;
  return out + (body.is(Kind::Block) ? parts(body, body.begin + 1, body.end) : " " + of(&body) + " }");
}

std::string Lowering::loop(const Node& node) {
  frames_.push_back({Frame::Kind::Loop, std::move(labels_)});
  labels_.clear();
  std::string out;
  if (node.is(Kind::For)) {
    out = forLoop(node);
  } else if (node.is(Kind::ForIn)) {
    out = forIn(node);
  } else if (node.is(Kind::ForOf)) {
    out = forOf(node);
  } else if (!passes_.contains(&node)) {
    out = parts(node);
  } else {
    const Node& body = *bodyOf(node);
    const Node& condition = *node.kids[node.is(Kind::While) ? 0 : 1];
    const std::string text = "{" + pass(body, "", "", "", "") + " }";
    out = node.is(Kind::While)
              ? slice(node.begin, condition.begin) + of(&condition) + slice(condition.end, body.begin) + text
              : slice(node.begin, body.begin) + text + slice(body.end, condition.begin) + of(&condition) +
                    slice(condition.end, node.end);
  }
  frames_.pop_back();
  return out;
}

// `var` belongs to the function around the pass.
void Lowering::hoist(const std::string& name) {
  std::vector<std::string>& all = temporaries_.back();
  if (std::find(all.begin(), all.end(), name) == all.end()) all.push_back(name);
}

void Lowering::hoistAll(const Node& target) {
  if (target.is(Kind::Name)) return hoist(of(&target));
  if (target.is(Kind::Property) || target.is(Kind::Default) || target.is(Kind::Spread))
    return hoistAll(*(target.is(Kind::Property) ? target.kids.back() : target.kids.front()));
  for (const Node* one : target.kids)
    if (one != nullptr) hoistAll(*one);
}

} // namespace dotek::frontend::fusion
