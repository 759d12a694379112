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

const Node* objectOf(const PostFile& post, const Node* node) {
  node = fusion::bare(node);
  if (node == nullptr || !node->is(Kind::Name)) return node;
  const fusion::Symbol* const symbol = post.scopes.symbolOf(node);
  if (symbol == nullptr || symbol->value == nullptr) return node;
  for (const fusion::Use& use : post.scopes.uses)
    if (use.symbol == symbol && use.kind != fusion::Use::Kind::Read && use.value != symbol->value)
      return node;
  const Node* const value = fusion::bare(symbol->value);
  return value->is(Kind::Object) || value->is(Kind::Array) ? value : node;
}

bool callsMeasuringMacro(const Node& call) {
  for (std::size_t i = 1; i < call.kids.size() && i < 4; ++i) {
    const Node* part = fusion::bare(call.kids[i]);
    std::string text;
    if (part->is(Kind::Binary) && part->text == "+" && textLiteral(part->kids[0]) == "P" &&
        part->kids[1]->is(Kind::Number))
      text = "P" + std::string(part->kids[1]->text);
    else
      text = std::string(textLiteral(part));
    const std::size_t at = text.find('P');
    if (at == std::string::npos || text.size() < at + 5) continue;
    const std::string number = text.substr(at + 1, 4);
    if (number.find_first_not_of("0123456789") != std::string::npos) continue;
    return (number[0] == '9' || number[0] == '8') && number[1] == '8' && number.substr(2) != "10" &&
           number.substr(2) != "32" && number.substr(2) != "33";
  }
  return false;
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
    if (const Node* first = objectOf(post, value->kid(1)); first != nullptr && first->is(Kind::Object)) {
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
