// Syntax tree of a post: JavaScript, ES5 and what posts use of ES6.
#pragma once

#include "frontend/fusion/Tokens.h"

#include <deque>

namespace dotek::frontend::fusion {

// After each kind: what its children are, in the order of the text. `?`: nullptr where there is none.
enum class Kind : std::uint8_t {
  // Statements
  Block,      // statement*
  Variables,  // Declarator*; `text` is var, let or const
  Declarator, // name or pattern, value?
  Function,   // Name?, Parameters, Block; a statement or a value
  Class,      // Name?, base?, Method*
  If,         // condition, statement, statement?
  For,        // first?, condition?, step?, statement
  ForIn,      // Variables or target, value, statement
  ForOf,      // the same
  While,      // condition, statement
  DoWhile,    // statement, condition
  Return,     // value?
  Throw,      // value
  Break,      // Name?
  Continue,   // Name?
  Try,        // Block, Catch?, Block?
  Catch,      // name or pattern?, Block
  Switch,     // value, Case*
  Case,       // value? (none: default), statement*
  Label,      // Name, statement
  Evaluate,   // value: an expression as a statement
  Empty,      //
  Error,      // what could not be read
  // Expressions
  Name,        // `text`
  Number,      //
  String,      // `text` with its quotes
  Template,    // value*; the texts lie between them
  Regex,       //
  Literal,     // true, false, null
  This,        //
  Super,       //
  Array,       // element*; nullptr: a hole
  Object,      // Property, Method or Spread
  Property,    // key, value; `flag`: only a name, which is both
  Method,      // key, Function; `text`: "", get, set; `flag`: static
  Field,       // key, value?: of a class; `flag`: static
  Computed,    // value: a key in brackets
  Spread,      // value
  Unary,       // value; `text` is the operator, as of all below
  Update,      // value; `flag`: before it
  Binary,      // left, right; && and || and ?? too
  Assign,      // target, value
  Conditional, // condition, value, value
  Call,        // function, argument*; `flag`: ?.
  New,         // function, argument*
  Member,      // object, Name; `flag`: ?.
  Index,       // object, value; `flag`: ?.
  Sequence,    // value*
  Arrow,       // Parameters, Block or value
  Brackets,    // value
  Tagged,      // function, Template
  // Patterns
  Parameters,    // name, pattern, Default, Spread
  ArrayPattern,  // element*; nullptr: a hole
  ObjectPattern, // Property or Spread
  Default,       // name or pattern, value
};

struct Node {
  Kind kind = Kind::Error;
  bool flag = false;
  bool brackets = false; // of parameters: they are written
  std::uint32_t begin = 0, end = 0;
  std::string_view text;
  std::vector<Node*> kids;

  const Node* kid(std::size_t i) const { return i < kids.size() ? kids[i] : nullptr; }
  bool is(Kind which) const { return kind == which; }
  bool isName(std::string_view name) const { return kind == Kind::Name && text == name; }
};

struct Unread {
  SourceRange range;
  std::string message;
};

// One script. Nodes point into the text of the file.
struct Tree {
  FileId file = kNoFile;
  std::string_view text;
  Tokens tokens;
  std::deque<Node> nodes; // all, in the order of reading
  std::vector<Node*> body;
  std::vector<Unread> unread; // what is no JavaScript

  SourceRange range(const Node& node) const { return {file, node.begin, node.end}; }
  std::string_view textOf(const Node& node) const { return text.substr(node.begin, node.end - node.begin); }
};

// `a.b.c` of a Member with names alone, "" for anything else.
std::string dotted(const Node* node);
// The text of a String without quotes, escapes as they are written.
std::string_view stringText(const Node& node);
// The same node without the brackets around it.
const Node* bare(const Node* node);

} // namespace dotek::frontend::fusion
