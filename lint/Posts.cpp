#include "lint/Posts.h"

#include "lint/Analyses.h"

namespace dotek::lint {

using fusion::Kind;
using fusion::Node;

const std::vector<const PostFile*>& postsOf(const Project& project) {
  return project.analyses->posts;
}

std::string calledName(const Node& call) {
  return fusion::dotted(fusion::bare(call.kid(0)));
}

std::string_view textLiteral(const Node* node) {
  node = fusion::bare(node);
  return node != nullptr && node->is(Kind::String) ? fusion::stringText(*node) : std::string_view();
}

std::string_view keyOf(const Node& property) {
  const Node& key = *property.kids[0];
  return key.is(Kind::String) ? fusion::stringText(key) : key.text;
}

const Node* propertyOf(const Node* object, std::string_view name) {
  if (object == nullptr || !object->is(Kind::Object)) return nullptr;
  for (const Node* one : object->kids)
    if (one->is(Kind::Property) && keyOf(*one) == name) return one->kids[1];
  return nullptr;
}

bool endsFlow(const Node* statement) {
  if (statement == nullptr) return false;
  switch (statement->kind) {
  case Kind::Return:
  case Kind::Throw:
  case Kind::Break:
  case Kind::Continue: return true;
  case Kind::Block: return !statement->kids.empty() && endsFlow(statement->kids.back());
  case Kind::If: return endsFlow(statement->kid(1)) && endsFlow(statement->kid(2));
  case Kind::Evaluate: {
    const Node* const value = fusion::bare(statement->kids[0]);
    if (!value->is(Kind::Call)) return false;
    const std::string name = calledName(*value);
    return name == "error" || name == "cycleNotSupported";
  }
  case Kind::Switch: {
    bool other = false;
    for (std::size_t i = 1; i < statement->kids.size(); ++i) {
      const Node& one = *statement->kids[i];
      other = other || one.kids[0] == nullptr;
      bool leaves = false;
      for (std::size_t k = 1; k < one.kids.size(); ++k)
        walk(one.kids[k], [&](const Node& node) { leaves = leaves || node.is(Kind::Break); });
      if (leaves) return false;
      if (i + 1 == statement->kids.size() && (one.kids.size() < 2 || !endsFlow(one.kids.back())))
        return false;
    }
    return other;
  }
  default: return false;
  }
}

void walk(const Node* node, const std::function<void(const Node&)>& visit, bool functions) {
  if (node == nullptr) return;
  visit(*node);
  for (const Node* kid : node->kids) {
    if (kid == nullptr || (!functions && (kid->is(Kind::Function) || kid->is(Kind::Arrow)))) continue;
    walk(kid, visit, functions);
  }
}

const Node* topLevelValue(const PostFile& post, std::string_view name) {
  const Node* out = nullptr;
  const fusion::Symbol* const symbol = post.scopes.global(name);
  if (symbol == nullptr) return nullptr;
  if (symbol->value != nullptr) out = symbol->value;
  for (const fusion::Use& use : post.scopes.uses)
    if (use.symbol == symbol && use.kind == fusion::Use::Kind::Write &&
        use.scope->function->parent == nullptr && use.value != nullptr)
      out = use.value;
  return out;
}

std::vector<Made> madeOf(const PostFile& post) {
  std::vector<Made> out;
  const auto take = [&](const fusion::Symbol& symbol, const Node* value) {
    value = fusion::bare(value);
    if (value == nullptr || !value->is(Kind::Call) || !value->kids[0]->is(Kind::Name)) return;
    const std::string_view maker = value->kids[0]->text;
    if (maker != "createFormat" && maker != "createVariable" && maker != "createModal" &&
        maker != "createOutputVariable" && maker != "createReferenceVariable" &&
        maker != "createIncrementalVariable" && maker != "createModalGroup")
      return;
    Made one{&symbol, maker, value, nullptr, {}};
    if (const Node* first = fusion::bare(value->kid(1)); first != nullptr && first->is(Kind::Object)) {
      one.specifiers = first;
      one.prefix = textLiteral(propertyOf(first, "prefix"));
    }
    out.push_back(one);
  };
  for (const fusion::Symbol& symbol : post.scopes.symbols)
    if (symbol.scope->parent == nullptr) take(symbol, symbol.value);
  for (const fusion::Use& use : post.scopes.uses)
    if (use.kind == fusion::Use::Kind::Write && use.symbol->scope->parent == nullptr &&
        use.value != nullptr && use.value != use.symbol->value)
      take(*use.symbol, use.value);
  return out;
}

} // namespace dotek::lint
