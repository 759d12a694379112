// Which variable a name means.
#pragma once

#include "frontend/fusion/Ast.h"

#include <map>
#include <memory>
#include <unordered_map>

namespace dotek::frontend::fusion {

struct Scope;

struct Symbol {
  enum class Kind : std::uint8_t { Var, Let, Const, Function, Class, Parameter, Catch, Global };
  Kind kind = Kind::Var; // Global: declared nowhere in the script
  std::string_view name;
  Scope* scope = nullptr;
  const Node* declaration = nullptr; // the Name; of Global nullptr
  const Node* value = nullptr;       // that the declaration gives, a Function or Class too
};

struct Use {
  enum class Kind : std::uint8_t { Read, Write, ReadWrite, TypeOf };
  const Node* name = nullptr;
  Symbol* symbol = nullptr;
  Kind kind = Kind::Read;
  Scope* scope = nullptr;       // where it is used
  const Node* value = nullptr;  // of a write
  const Node* parent = nullptr; // Call, Member, ...: what it is a part of; nullptr: a statement
};

struct Scope {
  const Node* node = nullptr; // Function, Arrow, Method's Function, Block, For, ...; nullptr: the script
  Scope* parent = nullptr;
  Scope* function = nullptr; // of the nearest function, or of the script; itself where it is one
  bool inLoop = false;       // made anew in each pass of a loop of the same function
  std::map<std::string_view, Symbol*> names;
  bool usesThis = false, usesArguments = false; // of functions: arrows within count
};

// Of one script. Writes to names that nothing declares make a Global, as the engine does.
struct Scopes {
  std::deque<Scope> scopes; // the first is the script
  std::deque<Symbol> symbols;
  std::vector<Use> uses;                           // in the order of the walk
  std::unordered_map<const Node*, Scope*> ofNode;  // nodes that have a scope
  std::unordered_map<const Node*, Symbol*> ofName; // each Name that is a variable

  Symbol* global(std::string_view name) const; // nullptr: there is none
  const Symbol* symbolOf(const Node* name) const;
};

Scopes resolve(const Tree& tree);

} // namespace dotek::frontend::fusion
