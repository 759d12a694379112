#include "frontend/fusion/Units.h"

#include <algorithm>

namespace dotek::frontend::fusion {

namespace {

bool isUnit(const Node* node, const Scopes& scopes) {
  if (node == nullptr) return false;
  const Node* const one = bare(node);
  if (one->is(Kind::Call)) return one->kids.size() == 1 && bare(one->kids[0])->isName("getOutputUnit");
  if (!one->isName("unit")) return false;
  const Symbol* const symbol = scopes.symbolOf(one);
  return symbol == nullptr || symbol->kind == Symbol::Kind::Global;
}

bool isNumber(const Node* node) {
  const Node* const one = bare(node);
  return one->is(Kind::Number) || (one->is(Kind::Unary) && one->text != "typeof" && isNumber(one->kids[0]));
}

} // namespace

std::vector<const Node*> unitsAsNumbers(const Tree& tree, const Scopes& scopes) {
  std::vector<const Node*> out;
  for (const Node& node : tree.nodes) {
    bool found = false;
    switch (node.kind) {
    case Kind::Binary: {
      const bool logic = node.text == "&&" || node.text == "||";
      found = logic ? isUnit(node.kids[0], scopes)
                    : node.text != "?\?" && ((isUnit(node.kids[0], scopes) && isNumber(node.kids[1])) ||
                                             (isUnit(node.kids[1], scopes) && isNumber(node.kids[0])));
      break;
    }
    case Kind::Unary: found = node.text == "!" && isUnit(node.kids[0], scopes); break;
    case Kind::If:
    case Kind::Conditional: {
      if (!isUnit(node.kids[0], scopes)) break;
      out.push_back(node.kids[0]);
      break;
    }
    case Kind::Index: found = isUnit(node.kids[1], scopes); break;
    case Kind::Switch:
      if (isUnit(node.kids[0], scopes) &&
          std::any_of(node.kids.begin() + 1, node.kids.end(),
                      [](const Node* one) { return one->kids[0] != nullptr && isNumber(one->kids[0]); }))
        out.push_back(node.kids[0]);
      break;
    default: break;
    }
    if (found) out.push_back(&node);
  }
  return out;
}

} // namespace dotek::frontend::fusion
