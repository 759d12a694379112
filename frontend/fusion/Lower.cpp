#include "frontend/fusion/Lower.h"

#include "frontend/fusion/Lowering.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace dotek::frontend::fusion {

namespace {

bool isScope(const Symbol& symbol) {
  return symbol.kind == Symbol::Kind::Let || symbol.kind == Symbol::Kind::Const ||
         symbol.kind == Symbol::Kind::Class;
}

} // namespace

void Lowering::refuse(const Node& node, std::string what) {
  out_.refused.push_back({tree_.range(node), std::move(what)});
}

std::string Lowering::lines(std::uint32_t from, std::uint32_t to) const {
  if (from >= to) return "";
  return std::string(
      static_cast<std::size_t>(std::count(tree_.text.begin() + from, tree_.text.begin() + to, '\n')), '\n');
}

std::string Lowering::filled(std::string text, std::uint32_t from, std::uint32_t to) const {
  const std::size_t wanted = lines(from, to).size();
  const auto have = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
  if (have < wanted) text += std::string(wanted - have, '\n');
  return text;
}

std::string Lowering::ownName() {
  std::string name;
  do
    name = fmt::format("$d{}", ++count_);
  while (names_.contains(name));
  return name;
}

std::string Lowering::temporary() {
  return temporaries_.back().emplace_back(ownName());
}

// A let or const of a block whose name means something else in the same function gets one of its own.
void Lowering::rename() {
  std::map<std::pair<const Scope*, std::string_view>, std::set<const Symbol*>> of;
  for (const Symbol& symbol : scopes_.symbols) {
    names_.emplace(symbol.name);
    if (symbol.kind != Symbol::Kind::Global) of[{symbol.scope->function, symbol.name}].insert(&symbol);
  }
  for (const Use& use : scopes_.uses) {
    if (use.symbol->kind == Symbol::Kind::Const && use.name != use.symbol->declaration &&
        (use.kind == Use::Kind::Write || use.kind == Use::Kind::ReadWrite))
      fixed_.insert(use.name);
    const Scope* const home = use.symbol->scope->function;
    for (const Scope* at = use.scope->function; at != home && at->parent != nullptr;
         at = at->parent->function)
      of[{at, use.symbol->name}].insert(use.symbol);
  }
  for (const Symbol& symbol : scopes_.symbols) {
    if (!isScope(symbol) || symbol.scope == symbol.scope->function) continue;
    if (of[{symbol.scope->function, symbol.name}].size() < 2) continue;
    std::string name;
    int count = 0;
    do
      name = fmt::format("{}${}", symbol.name, ++count);
    while (!names_.insert(name).second);
    renamed_[&symbol] = name;
  }
}

// Functions that are called within the pass in which they are made see what they would see.
bool Lowering::staysInPass(const Use& use) const {
  constexpr auto kAtOnce = std::to_array<std::string_view>(
      {"forEach", "map", "filter", "find", "findIndex", "some", "every", "reduce", "reduceRight", "flatMap",
       "findLast", "findLastIndex", "sort", "replace"});
  const auto calledAtOnce = [&](const Node* inner) {
    for (const Node& node : tree_.nodes) {
      if (!node.is(Kind::Call)) continue;
      const bool argument = std::find(node.kids.begin() + 1, node.kids.end(), inner) != node.kids.end();
      const Node* const called = bare(node.kids[0]);
      if (called == inner) return true; // (function () {..})()
      if (!argument || !called->is(Kind::Member)) continue;
      return std::find(kAtOnce.begin(), kAtOnce.end(), called->kids[1]->text) != kAtOnce.end();
    }
    return false;
  };
  for (const Scope* at = use.scope->function; at != use.symbol->scope->function; at = at->parent->function)
    if (!calledAtOnce(at->node)) return false;
  return true;
}

bool Lowering::keyIs(const Node& key, std::string_view name) {
  return key.isName(name) || (key.is(Kind::String) && stringText(key) == name);
}

bool Lowering::changes(const Node& node) const {
  switch (node.kind) {
  case Kind::For:
  case Kind::ForIn:
  case Kind::While:
  case Kind::DoWhile:
  case Kind::Switch:
  case Kind::Label:
  case Kind::Return:
  case Kind::Break:
  case Kind::Continue: return !passes_.empty();
  case Kind::Variables: return node.text != "var" || !passes_.empty();
  case Kind::Declarator: return !node.kids[0]->is(Kind::Name);
  case Kind::Class:
  case Kind::ForOf:
  case Kind::Template:
  case Kind::Tagged:
  case Kind::Arrow:
  case Kind::Super:
  case Kind::Spread:
  case Kind::Computed:
  case Kind::ArrayPattern:
  case Kind::ObjectPattern:
  case Kind::Default:
  case Kind::Field: return true;
  case Kind::Property: return node.flag || keyIs(*node.kids[0], "__proto__");
  case Kind::Number: return node.text.find('_') != std::string_view::npos;
  case Kind::Parameters: { // a comma after the last one
    const std::uint32_t from = node.kids.empty() ? node.end : node.kids.back()->end;
    const std::string_view rest = tree_.text.substr(from, node.end - from);
    const std::size_t at = rest.find_first_not_of(" \t\r\n");
    return at != std::string_view::npos && rest[at] == ',';
  }
  case Kind::Method: return node.text.empty();
  case Kind::Catch: return node.kids[0] == nullptr || !node.kids[0]->is(Kind::Name);
  case Kind::Name: {
    const Symbol* const symbol = scopes_.symbolOf(&node);
    return fixed_.contains(&node) || (symbol != nullptr && renamed_.contains(symbol));
  }
  case Kind::Binary: return node.text == "?\?" || node.text == "**";
  case Kind::Assign:
    return node.text == "**=" || node.text == "?\?=" || node.text == "||=" || node.text == "&&=";
  case Kind::Member:
  case Kind::Index: return node.flag;
  case Kind::New:
  case Kind::Call: {
    if (node.flag) return true;
    const std::string_view rest = tree_.text.substr(node.kids.back()->end, node.end - node.kids.back()->end);
    return node.kids.size() > 1 && rest.find_first_not_of(" \t\r\n") != std::string_view::npos &&
           rest[rest.find_first_not_of(" \t\r\n")] == ',';
  }
  case Kind::Regex: {
    const std::size_t flags = node.text.rfind('/') + 1;
    return node.text.find_first_not_of("gim", flags) != std::string_view::npos ||
           node.text.find("(?<") != std::string_view::npos;
  }
  default: return false;
  }
}

bool Lowering::mark(const Node* node) {
  bool any = changes(*node);
  for (const Node* kid : node->kids)
    if (kid != nullptr && mark(kid)) any = true;
  if (any) changes_.insert(node);
  return any;
}

std::string Lowering::parts(const Node& node, std::uint32_t from, std::uint32_t to) {
  std::string out;
  for (const Node* kid : node.kids) {
    if (kid == nullptr || kid->begin < from) continue;
    out += slice(from, kid->begin) + of(kid);
    from = kid->end;
  }
  return out + slice(from, to);
}

std::string Lowering::of(const Node* node) {
  if (node == nullptr) return "";
  if (!changes_.contains(node)) return std::string(tree_.textOf(*node));
  return changed(*node);
}

std::string Lowering::changed(const Node& node) {
  switch (node.kind) {
  case Kind::Variables: return variables(node, false);
  case Kind::Declarator: return declarator(node, false);
  case Kind::Number: {
    std::string out(node.text);
    std::erase(out, '_');
    return out;
  }
  case Kind::Template: return templateText(node);
  case Kind::Tagged: refuse(node, "a tagged template literal"); return "undefined";
  case Kind::Arrow: return arrow(node);
  case Kind::Function: return function(node);
  case Kind::For:
  case Kind::ForIn:
  case Kind::ForOf:
  case Kind::While:
  case Kind::DoWhile: return loop(node);
  case Kind::Switch: {
    frames_.push_back({Frame::Kind::Switch, std::move(labels_)});
    labels_.clear();
    std::string out = parts(node);
    frames_.pop_back();
    return out;
  }
  case Kind::Label: {
    labels_.push_back(node.kids[0]->text);
    const Kind kind = node.kids[1]->kind;
    const bool taken = kind == Kind::For || kind == Kind::ForIn || kind == Kind::ForOf ||
                       kind == Kind::While || kind == Kind::DoWhile || kind == Kind::Switch ||
                       kind == Kind::Label;
    if (!taken) {
      frames_.push_back({Frame::Kind::Block, std::move(labels_)});
      labels_.clear();
    }
    std::string out = parts(node);
    if (!taken) frames_.pop_back();
    labels_.clear();
    return out;
  }
  case Kind::Return:
  case Kind::Break:
  case Kind::Continue: return leave(node);
  case Kind::Array: return array(node);
  case Kind::Object: return object(node);
  case Kind::Property:
  case Kind::Method: return objectPart(node);
  case Kind::Call:
  case Kind::New: return call(node);
  case Kind::Member:
  case Kind::Index: return chain(node);
  case Kind::Binary: return binary(node);
  case Kind::Assign: return assign(node);
  case Kind::Class: return classText(node);
  case Kind::Name: {
    if (fixed_.contains(&node)) return fmt::format("dotekEs6.constant(\"{}\").value", node.text);
    const auto at = renamed_.find(scopes_.symbolOf(&node));
    return at == renamed_.end() ? std::string(node.text) : at->second;
  }
  case Kind::Catch: {
    if (node.kids[0] == nullptr) return "catch (" + ownName() + ") " + of(node.kids[1]);
    if (node.kids[0]->is(Kind::Name)) return parts(node);
    const std::string name = ownName();
    std::vector<std::string> bound;
    bind(*node.kids[0], name, bound);
    std::string head;
    for (const std::string& one : bound)
      head += (head.empty() ? "var " : ", ") + one;
    const Node& body = *node.kids[1];
    return "catch (" + name + ") {" + head + ";" + parts(body, body.begin + 1, body.end);
  }
  case Kind::Regex: refuse(node, "a regular expression of a newer kind"); return "/x/";
  case Kind::Super: refuse(node, "`super` in this place"); return "undefined";
  case Kind::Spread: refuse(node, "`...` in this place"); return "undefined";
  default: return parts(node);
  }
}

Lowered Lowering::run() {
  rename();
  findPasses();
  bool any = false;
  for (const Node* node : tree_.body)
    any = mark(node) || any;
  if (!any) {
    out_.text = std::string(tree_.text);
  } else {
    std::uint32_t from = 0;
    for (const Node* node : tree_.body) {
      out_.text += slice(from, node->begin) + of(node);
      from = node->end;
    }
    out_.text += slice(from, static_cast<std::uint32_t>(tree_.text.size()));
    std::string head;
    for (const std::string& name : temporaries_.front())
      head += (head.empty() ? "var " : ", ") + name;
    if (!head.empty()) out_.text.insert(0, head + "; ");
  }
  // Lines that a version control left are comments to the parser.
  for (const SourceRange& one : tree_.tokens.mergeMarkers)
    out_.refused.push_back({one, "a conflict of a version control"});
  return std::move(out_);
}

Lowered lower(const Tree& tree, const Scopes& scopes) {
  return Lowering(tree, scopes).run();
}

} // namespace dotek::frontend::fusion
