// Syntax tree of a ComPost Prog. Keeps what the programmer wrote; broken parts are ErrorStatement, ErrorItem.
#pragma once

#include "support/Source.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace dotek::frontend::compost {

// 'text' between apostrophes; `text` holds the bytes between them, leading blanks included.
struct Literal {
  SourceRange range;
  std::string text;
};

// By its suffix: none, `#`, `?`.
enum class WordKind : std::uint8_t { Command, Numeric, Boolean };

// A keyword or the name of a routine, with its arguments: SpinOff, OpFieldData#('D'), Flag?('f').
struct Word {
  SourceRange range;
  SourceRange nameRange; // name and suffix
  std::string name;      // without the suffix, as written
  WordKind kind = WordKind::Command;
  std::vector<Literal> arguments;
};

// EOL: ends the NC block.
struct EndOfLine {
  SourceRange range;
};

struct Condition;

struct ConditionError {};

// One operand. Each NOT before it is kept, unverified.
struct ConditionTerm {
  SourceRange range;
  std::vector<SourceRange> nots;
  std::variant<Word, std::unique_ptr<Condition>, ConditionError>
      operand; // Condition: in brackets, unverified
};

enum class Connective : std::uint8_t { And, Or }; // Or is unverified

// Operands in source order, with one connective between each two. No precedence of AND and OR is known:
// whoever evaluates a mix of both has to say which reading it takes.
struct Condition {
  SourceRange range;
  std::vector<ConditionTerm> terms;
  std::vector<Connective> connectives;
};

struct ErrorStatement {
  SourceRange range;
};

struct If;
using Statement = std::variant<Literal, Word, EndOfLine, std::unique_ptr<If>, ErrorStatement>;

struct If {
  SourceRange range;   // IF to END, or to the end of the last statement where END is missing
  SourceRange ifRange; // the word IF
  Condition condition;
  std::vector<Statement> thenBody;
  std::optional<SourceRange> elseRange; // the word ELSE
  std::vector<Statement> elseBody;
  std::optional<SourceRange> endRange; // the word END; nothing: left open at RETURN
};

// name: ... RETURN
struct Routine {
  SourceRange range;
  SourceRange nameRange; // without the colon
  std::string name;
  std::vector<Statement> body;
  std::optional<SourceRange> returnRange; // nothing: RETURN is missing
};

// #10 = '###.##;0'
struct PictureDefinition {
  SourceRange range;
  SourceRange numberRange;
  std::uint32_t number = 0;
  Literal picture;
};

// FORMAT(OpFieldData#,10)
struct FormatDirective {
  SourceRange range;
  SourceRange nameRange;
  std::string name; // without the suffix
  WordKind kind = WordKind::Numeric;
  SourceRange numberRange;
  std::uint32_t number = 0;
};

struct ErrorItem {
  SourceRange range;
};

using Item = std::variant<Routine, PictureDefinition, FormatDirective, ErrorItem>;

// { text }
struct Comment {
  SourceRange range;
  std::string text; // bytes between the braces
};

struct Program {
  FileId file = kNoFile;
  std::vector<Item> items; // in source order
  std::map<std::string, std::size_t, std::less<>>
      routines;                  // place in `items` of the first routine of each name
  std::vector<Comment> comments; // in source order
  bool hasErrorNodes = false;    // something could not be parsed: dump and lint run, post refuses
};

} // namespace dotek::frontend::compost
