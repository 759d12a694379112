#include "frontend/fusion/Declared.h"

#include <fmt/format.h>

namespace dotek::frontend::fusion {

namespace {

bool once(Symbol::Kind kind) {
  return kind == Symbol::Kind::Let || kind == Symbol::Kind::Const || kind == Symbol::Kind::Class;
}

void namesOf(const Node* pattern, std::vector<const Node*>& out) {
  if (pattern == nullptr) return;
  switch (pattern->kind) {
  case Kind::Name: out.push_back(pattern); return;
  case Kind::Default:
  case Kind::Spread: return namesOf(pattern->kids.front(), out);
  case Kind::Property: return namesOf(pattern->kids.back(), out);
  case Kind::ArrayPattern:
  case Kind::ObjectPattern:
    for (const Node* one : pattern->kids)
      namesOf(one, out);
    return;
  default: return;
  }
}

std::string nameOf(const Node& target) {
  if (target.is(Kind::Name)) return std::string(target.text);
  if (target.is(Kind::String)) return std::string(stringText(target));
  if (target.is(Kind::Member)) return std::string(target.kids[1]->text);
  return "";
}

} // namespace

std::vector<Unread> declaredTwice(const Tree& tree, const Scopes& scopes) {
  std::vector<Unread> out;
  const auto check = [&](const Node* name, bool alone) {
    const Symbol* const symbol = scopes.symbolOf(name);
    if (symbol == nullptr || symbol->declaration == nullptr || symbol->declaration == name) return;
    if (!alone && !once(symbol->kind)) return;
    // A function that is a value has its name for itself, and may use it for something else.
    if (symbol->value != nullptr && symbol->scope->node == symbol->value) return;
    out.push_back(
        {tree.range(*name),
         fmt::format("`{}` is declared twice here, and `let`, `const` and `class` do so once", name->text)});
  };
  for (const Node& node : tree.nodes) {
    if (node.is(Kind::Variables)) {
      std::vector<const Node*> names;
      for (const Node* one : node.kids)
        namesOf(one->kids[0], names);
      for (const Node* name : names)
        check(name, node.text != "var");
    } else if ((node.is(Kind::Function) || node.is(Kind::Class)) && node.kids[0] != nullptr) {
      check(node.kids[0], node.is(Kind::Class));
    }
  }
  return out;
}

std::vector<GivenFunction> givenFunctions(const Tree& tree) {
  std::unordered_map<const Node*, std::string> names;
  const auto give = [&](const Node* target, const Node* value) {
    if (target != nullptr && value != nullptr) names.emplace(bare(value), nameOf(*target));
  };
  for (const Node& node : tree.nodes) {
    switch (node.kind) {
    case Kind::Declarator:
    case Kind::Property:
    case Kind::Method:
    case Kind::Field: give(node.kid(0), node.kid(1)); break;
    case Kind::Assign:
      if (node.text == "=") give(node.kid(0), node.kid(1));
      break;
    default: break;
    }
  }
  std::vector<GivenFunction> out;
  for (const Node& node : tree.nodes) {
    if (!node.is(Kind::Arrow) && (!node.is(Kind::Function) || node.kids[0] != nullptr)) continue;
    const auto at = names.find(&node);
    out.push_back({node.begin, node.end, at == names.end() ? "" : at->second});
  }
  return out;
}

} // namespace dotek::frontend::fusion
