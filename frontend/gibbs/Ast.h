// Syntax trees of the GibbsCAM macro language: .mac programs, .dlg dialogs, DefineData.txt.
#pragma once

#include "support/Source.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace dotek::frontend::gibbs {

// ---- names ----------------------------------------------------------------------------------------------

// A variable, keyword, label or geometry reference; compared without case. `$` is part of a text name.
struct Name {
  SourceRange range;
  std::string text; // as written, with a final $
  bool isText() const { return !text.empty() && text.back() == '$'; }
};

// Upper case of ASCII letters: the key under which names are compared.
std::string foldCase(const std::string& name);

// ---- expressions ----------------------------------------------------------------------------------------

struct Expression;
using ExpressionPtr = std::unique_ptr<Expression>;

struct NumberLiteral {
  double value = 0;
  std::string text; // as written
};

struct TextLiteral {
  std::string text; // bytes between the quotes, a doubled quote as written
  char quote = '"'; // `'` is unverified; 0: a caption of a dialog that is without quotes
};

struct VariableRef {
  Name name;
  // An element of an array; how it is written is unverified.
  ExpressionPtr index;
  char bracket = 0; // '(' or '[' where there is an index
};

// A function of the table with its arguments: ABS(x). A name that no table knows, followed by one bracketed
// expression, is an array element instead.
struct FunctionCall {
  Name name;
  std::vector<ExpressionPtr> arguments;
};

enum class UnaryOperator : std::uint8_t { Plus, Minus };
struct Unary {
  UnaryOperator op = UnaryOperator::Minus;
  ExpressionPtr operand;
};

enum class BinaryOperator : std::uint8_t { Add, Subtract, Multiply, Divide };
struct Binary {
  BinaryOperator op = BinaryOperator::Add;
  ExpressionPtr left;
  ExpressionPtr right;
};

struct Bracketed {
  ExpressionPtr inner;
};

struct ErrorExpression {};

struct Expression {
  SourceRange range;
  std::variant<NumberLiteral, TextLiteral, VariableRef, FunctionCall, Unary, Binary, Bracketed,
               ErrorExpression>
      node;
};

enum class Relation : std::uint8_t { Equal, NotEqual, Less, Greater, LessEqual, GreaterEqual };

struct Comparison {
  SourceRange range;
  std::vector<SourceRange> nots;     // unverified
  std::vector<SourceRange> brackets; // around the whole comparison; unverified
  ExpressionPtr left;
  Relation relation = Relation::Equal;
  SourceRange relationRange;
  ExpressionPtr right;
};

enum class Connective : std::uint8_t { And, Or }; // both unverified

struct Condition {
  SourceRange range;
  std::vector<Comparison> comparisons;
  std::vector<Connective> connectives; // one fewer than comparisons
};

// ---- statements -----------------------------------------------------------------------------------------

struct Statement;
using StatementPtr = std::unique_ptr<Statement>;
struct Line;

struct Assignment {
  VariableRef target;
  ExpressionPtr value;
};

struct If {
  SourceRange ifRange;
  Condition condition;
  std::optional<SourceRange> commaBeforeThen;
  SourceRange thenRange;
  StatementPtr then; // one-line form
  // Block form `[` ... `]` on lines of their own, with an optional ELSE: unverified.
  std::vector<Line> thenBlock;
  std::optional<SourceRange> elseRange;
  StatementPtr elseStatement;
  std::vector<Line> elseBlock;
};

struct For {
  Name variable;
  ExpressionPtr from;
  ExpressionPtr to;
  ExpressionPtr step; // null: 1
};
struct Next {
  std::optional<Name> variable; // missing: unverified
};
struct Continue {};
struct Goto {
  Name label;
};
// CALL macro [, arguments]; the macro is a text expression or a bare file name.
struct CallMacro {
  ExpressionPtr macro; // null where a bare name is
  std::string bareName;
  SourceRange macroRange;
  std::vector<ExpressionPtr> arguments;
};
struct Args {
  std::vector<VariableRef> names;
};
enum class Scope : std::uint8_t { Global, Local, Permanent };
struct Declaration {
  Scope scope = Scope::Global;
  std::vector<VariableRef> names; // an index is the (unverified) number of elements
};
struct Include {
  std::string file; // without quotes
  SourceRange fileRange;
};
struct OnError {
  Name label;
};
// Any command of the table, MESSAGE, DIALOG and unknown ones included. Which argument is a parameter
// keyword and which a variable is decided by its position (stdlib/keywords), not here: a bare word is a
// VariableRef.
struct Command {
  Name name;
  std::optional<SourceRange> commaAfterName;
  std::vector<ExpressionPtr> arguments;
};
// CONTOUR, CONTOUR_3D, POINTS: `[`, elements, `]`.
struct GeometryBlock {
  Name kind;
  std::vector<Command> elements; // START, RAPID, LINE, ARC, POINT
  std::vector<SourceRange> elementRanges;
  std::optional<SourceRange> closeRange; // nothing: the block is never closed
};
struct ErrorStatement {};

struct Statement {
  SourceRange range;
  std::variant<Assignment, If, For, Next, Continue, Goto, CallMacro, Args, Declaration, Include, OnError,
               Command, std::unique_ptr<GeometryBlock>, ErrorStatement>
      node;
};

// `:name` or `name:`, alone on its line.
struct Label {
  Name name;
  bool colonFirst = true;
};

struct Line {
  std::optional<Label> label;
  StatementPtr statement; // null on a line with a label or a comment only
};

// ! text, to the end of the line
struct Comment {
  SourceRange range;
  std::string text;
};

// One .mac file. Blank lines and lines with a comment only give no Line.
struct Macro {
  FileId file = kNoFile;
  std::vector<Line> lines;
  std::vector<Comment> comments;
  bool hasErrorNodes = false;
};

// ---- dialog ---------------------------------------------------------------------------------------------

// Rectangle in pixels, from the window's top left corner; y grows downwards. Nothing where the file gives
// no plain numbers.
struct Box {
  int left = 0, top = 0, width = 0, height = 0;
};

// One line of a .dlg: DIALOG, FONT, LABEL, INPUT, OK ... and any unknown word.
struct Control {
  SourceRange range;
  Name kind;
  std::vector<ExpressionPtr> arguments; // all, as written; of SET_STATE those after the condition
  std::optional<Comparison> condition;  // of SET_STATE
  std::optional<Box> box;               // of the controls that have one
  std::optional<std::string> text;      // caption or label text, bytes
  std::optional<Name> variable;         // INPUT, CHECK, RADIO, BUTTON, DROPDOWN_NEW
  const Expression* initial = nullptr;  // default of INPUT, CHECK, RADIO; points into `arguments`
};

struct Dialog {
  FileId file = kNoFile;
  std::vector<Control> controls;
  std::vector<Comment> comments;
  bool hasErrorNodes = false;
};

// ---- DefineData.txt -------------------------------------------------------------------------------------

// NAME = number. Another right side is kept as an expression, unverified.
struct Definition {
  SourceRange range;
  Name name;
  std::optional<double> number;
  SourceRange valueRange;
  ExpressionPtr value;
};

struct DefineData {
  FileId file = kNoFile;
  std::vector<Definition> definitions;
  std::vector<Comment> comments;
  bool hasErrorNodes = false;
};

} // namespace dotek::frontend::gibbs
