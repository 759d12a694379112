#include "frontend/fusion/Scopes.h"

namespace dotek::frontend::fusion {

namespace {

class Resolver {
public:
  explicit Resolver(Scopes& out) : out_(out) {}

  void script(const Tree& tree) {
    Scope& top = out_.scopes.emplace_back();
    top.function = &top;
    scope_ = &top;
    hoist(tree.body);
    declareBlock(tree.body);
    for (const Node* one : tree.body)
      visit(one, nullptr);
  }

private:
  Scope* open(const Node* node, bool function, bool inLoop = false) {
    Scope& scope = out_.scopes.emplace_back();
    scope.node = node;
    scope.parent = scope_;
    scope.function = function ? &scope : scope_->function;
    scope.inLoop = !function && (inLoop || scope_->inLoop);
    out_.ofNode[node] = &scope;
    return scope_ = &scope;
  }
  void close() { scope_ = scope_->parent; }

  Symbol* declare(const Node* name, Symbol::Kind kind, const Node* value, Scope* scope) {
    Symbol*& at = scope->names[name->text];
    // Of several declarations the first one is kept, but a function is what it is called for.
    if (at == nullptr || (kind == Symbol::Kind::Function && at->kind == Symbol::Kind::Var)) {
      at = &out_.symbols.emplace_back();
      *at = {kind, name->text, scope, name, value};
    }
    out_.ofName[name] = at;
    return at;
  }

  void declarePattern(const Node* target, Symbol::Kind kind, const Node* value, Scope* scope) {
    if (target == nullptr) return;
    switch (target->kind) {
    case Kind::Name: declare(target, kind, value, scope); return;
    case Kind::Default:
    case Kind::Spread: return declarePattern(target->kids.front(), kind, nullptr, scope);
    case Kind::Property: return declarePattern(target->kids.back(), kind, nullptr, scope);
    case Kind::ArrayPattern:
    case Kind::ObjectPattern:
      for (const Node* one : target->kids)
        declarePattern(one, kind, nullptr, scope);
      return;
    default: return;
    }
  }

  // `var` of a function, wherever they are in it.
  void hoist(const std::vector<Node*>& body) {
    for (const Node* one : body)
      hoist(one);
  }
  void hoist(const Node* node) {
    if (node == nullptr) return;
    switch (node->kind) {
    case Kind::Variables:
      if (node->text != "var") return;
      for (const Node* one : node->kids)
        declarePattern(one->kids[0], Symbol::Kind::Var, one->kids[1], scope_->function);
      return;
    case Kind::Block:
    case Kind::If:
    case Kind::For:
    case Kind::ForIn:
    case Kind::ForOf:
    case Kind::While:
    case Kind::DoWhile:
    case Kind::Try:
    case Kind::Catch:
    case Kind::Switch:
    case Kind::Case:
    case Kind::Label: return hoist(node->kids);
    default: return;
    }
  }

  // Functions, classes, let and const of one block.
  void declareBlock(const std::vector<Node*>& body) {
    for (const Node* one : body) {
      if (one == nullptr) continue;
      if (one->is(Kind::Function) && one->kids[0] != nullptr) {
        // As posts' engines do it, a function of a block is one of its function.
        declare(one->kids[0], Symbol::Kind::Function, one, scope_->function);
      } else if (one->is(Kind::Class) && one->kids[0] != nullptr) {
        declare(one->kids[0], Symbol::Kind::Class, one, scope_);
      } else if (one->is(Kind::Variables) && one->text != "var") {
        for (const Node* each : one->kids)
          declarePattern(each->kids[0], one->text == "let" ? Symbol::Kind::Let : Symbol::Kind::Const,
                         each->kids[1], scope_);
      } else if (one->is(Kind::Label)) {
        declareBlock({one->kids[1]});
      }
    }
  }

  Symbol* find(std::string_view name, bool write) {
    for (const Scope* scope = scope_; scope != nullptr; scope = scope->parent)
      if (const auto at = scope->names.find(name); at != scope->names.end()) return at->second;
    if (name == "arguments" && scope_->function->parent != nullptr) return nullptr;
    Scope& top = out_.scopes.front();
    Symbol& made = out_.symbols.emplace_back();
    made = {Symbol::Kind::Global, name, &top, nullptr, nullptr};
    static_cast<void>(write);
    top.names[name] = &made;
    return &made;
  }

  void use(const Node* name, Use::Kind kind, const Node* value, const Node* parent) {
    if (name->text == "arguments") {
      Scope* of = scope_->function;
      while (of->node != nullptr && of->node->is(Kind::Arrow))
        of = of->parent->function;
      if (of->parent != nullptr) {
        for (Scope* one = scope_->function;; one = one->parent->function) {
          one->usesArguments = true;
          if (one == of) return;
        }
      }
    }
    Symbol* const symbol = find(name->text, kind != Use::Kind::Read);
    if (symbol == nullptr) return;
    out_.ofName[name] = symbol;
    out_.uses.push_back({name, symbol, kind, scope_, value, parent});
  }

  void thisUsed() {
    for (Scope* one = scope_->function;; one = one->parent->function) {
      one->usesThis = true;
      if (one->node == nullptr || !one->node->is(Kind::Arrow)) return;
    }
  }

  void target(const Node* node, Use::Kind kind, const Node* value, const Node* parent) {
    if (node == nullptr) return;
    switch (node->kind) {
    case Kind::Name: return use(node, kind, value, parent);
    case Kind::Brackets: return target(node->kids.front(), kind, value, parent);
    case Kind::Default: target(node->kids[0], kind, nullptr, parent); return visit(node->kids[1], node);
    case Kind::Spread: return target(node->kids.front(), kind, nullptr, parent);
    case Kind::Property:
      if (node->kids[0]->is(Kind::Computed)) visit(node->kids[0], node);
      return target(node->kids.back(), kind, nullptr, parent);
    case Kind::ArrayPattern:
    case Kind::ObjectPattern:
      for (const Node* one : node->kids)
        target(one, kind, nullptr, parent);
      return;
    default: return visit(node, parent);
    }
  }

  // What patterns of declarations hold beside names.
  void patternValues(const Node* node) {
    if (node == nullptr) return;
    if (node->is(Kind::Computed)) return visit(node, nullptr);
    if (node->is(Kind::Default)) {
      patternValues(node->kids[0]);
      return visit(node->kids[1], node);
    }
    if (node->is(Kind::Property) && node->flag) return patternValues(node->kids[1]);
    if (node->is(Kind::Property) || node->is(Kind::Spread) || node->is(Kind::ArrayPattern) ||
        node->is(Kind::ObjectPattern))
      for (const Node* one : node->kids)
        patternValues(one);
  }

  void function(const Node* node, const Node* parameters, const Node* body) {
    Scope* const scope = open(node, true);
    if (node->is(Kind::Function) && node->kids[0] != nullptr && out_.ofName.count(node->kids[0]) == 0)
      declare(node->kids[0], Symbol::Kind::Function, node, scope);
    for (const Node* one : parameters->kids)
      declarePattern(one, Symbol::Kind::Parameter, nullptr, scope);
    if (body->is(Kind::Block)) {
      hoist(body->kids);
      declareBlock(body->kids);
    }
    for (const Node* one : parameters->kids)
      patternValues(one);
    if (body->is(Kind::Block))
      for (const Node* one : body->kids)
        visit(one, nullptr);
    else
      visit(body, node);
    close();
  }

  void block(const std::vector<Node*>& body) {
    declareBlock(body);
    for (const Node* one : body)
      visit(one, nullptr);
  }

  void all(const Node* node) {
    for (const Node* one : node->kids)
      visit(one, node);
  }

  void loopBody(const Node* body) {
    if (body == nullptr) return;
    if (!body->is(Kind::Block)) return visit(body, nullptr);
    open(body, false, true);
    block(body->kids);
    close();
  }

  void visit(const Node* node, const Node* parent) {
    if (node == nullptr) return;
    switch (node->kind) {
    case Kind::Name: return use(node, Use::Kind::Read, nullptr, parent);
    case Kind::This:
    case Kind::Super: return thisUsed();
    case Kind::Block:
      open(node, false);
      block(node->kids);
      return close();
    case Kind::Variables:
      for (const Node* one : node->kids) {
        patternValues(one->kids[0]);
        visit(one->kids[1], one);
      }
      return;
    case Kind::Function: return function(node, node->kids[1], node->kids[2]);
    case Kind::Arrow: return function(node, node->kids[0], node->kids[1]);
    case Kind::Class:
      visit(node->kids[1], node);
      open(node, false);
      if (node->kids[0] != nullptr && out_.ofName.count(node->kids[0]) == 0)
        declare(node->kids[0], Symbol::Kind::Class, node, scope_);
      for (std::size_t i = 2; i < node->kids.size(); ++i)
        visit(node->kids[i], node);
      return close();
    case Kind::For:
    case Kind::ForIn:
    case Kind::ForOf: return loop(node);
    case Kind::While: visit(node->kids[0], node); return loopBody(node->kids[1]);
    case Kind::DoWhile: loopBody(node->kids[0]); return visit(node->kids[1], node);
    case Kind::Catch:
      open(node, false);
      declarePattern(node->kids[0], Symbol::Kind::Catch, nullptr, scope_);
      visit(node->kids[1], nullptr);
      return close();
    case Kind::Switch: {
      visit(node->kids[0], node);
      open(node, false);
      for (std::size_t i = 1; i < node->kids.size(); ++i)
        declareBlock({node->kids[i]->kids.begin() + 1, node->kids[i]->kids.end()});
      for (std::size_t i = 1; i < node->kids.size(); ++i) {
        visit(node->kids[i]->kids[0], node->kids[i]);
        for (std::size_t k = 1; k < node->kids[i]->kids.size(); ++k)
          visit(node->kids[i]->kids[k], nullptr);
      }
      return close();
    }
    case Kind::Break:
    case Kind::Continue: return;
    case Kind::Label: return visit(node->kids[1], nullptr);
    case Kind::Assign:
      target(node->kids[0], node->text == "=" ? Use::Kind::Write : Use::Kind::ReadWrite, node->kids[1], node);
      return visit(node->kids[1], node);
    case Kind::Update: return target(node->kids[0], Use::Kind::ReadWrite, nullptr, node);
    case Kind::Unary:
      if (node->text == "typeof" && bare(node->kids[0])->is(Kind::Name))
        return use(bare(node->kids[0]), Use::Kind::TypeOf, nullptr, node);
      return all(node);
    case Kind::Member: return visit(node->kids[0], node);
    case Kind::Property:
      if (node->flag) return visit(node->kids[1], node);
      [[fallthrough]];
    case Kind::Method:
    case Kind::Field:
      if (node->kids[0]->is(Kind::Computed)) visit(node->kids[0], node);
      return visit(node->kids[1], node);
    case Kind::ArrayPattern:
    case Kind::ObjectPattern: return target(node, Use::Kind::Write, nullptr, parent);
    case Kind::If:
    case Kind::Evaluate:
    case Kind::Return:
    case Kind::Throw:
    default: return all(node);
    }
  }

  void loop(const Node* node) {
    open(node, false, true);
    const Node* const first = node->kids[0];
    if (first != nullptr && first->is(Kind::Variables) && first->text != "var") {
      for (const Node* each : first->kids)
        declarePattern(each->kids[0], first->text == "let" ? Symbol::Kind::Let : Symbol::Kind::Const,
                       each->kids[1], scope_);
    }
    if (node->is(Kind::For)) {
      visit(first, node);
      visit(node->kids[1], node);
      visit(node->kids[2], node);
      loopBody(node->kids[3]);
    } else {
      if (first->is(Kind::Variables)) {
        visit(first, node);
        for (const Node* each : first->kids)
          if (each->kids[0]->is(Kind::Name)) use(each->kids[0], Use::Kind::Write, nullptr, node);
      } else {
        target(first, Use::Kind::Write, nullptr, node);
      }
      visit(node->kids[1], node);
      loopBody(node->kids[2]);
    }
    close();
  }

  Scopes& out_;
  Scope* scope_ = nullptr;
};

} // namespace

Symbol* Scopes::global(std::string_view name) const {
  const auto at = scopes.front().names.find(name);
  return at == scopes.front().names.end() ? nullptr : at->second;
}

const Symbol* Scopes::symbolOf(const Node* name) const {
  const auto at = ofName.find(name);
  return at == ofName.end() ? nullptr : at->second;
}

Scopes resolve(const Tree& tree) {
  Scopes out;
  Resolver(out).script(tree);
  return out;
}

} // namespace dotek::frontend::fusion
