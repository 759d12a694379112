// One NC block, words with holes allowed. A hole is a value that the text does not hold: a field that a post
// prints there.
#pragma once

#include "ir/Statement.h"
#include "support/Picture.h"
#include "support/Source.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace dotek::frontend::nc {

// What fills a hole, and the picture that prints it (not owned; nullptr: printed in full with a point).
struct Hole {
  ir::ExpressionPtr value;
  const Picture* picture = nullptr;
  std::string name; // for messages: "field `D`", "host input `clearance`"
};

// Text of a block in pieces.
struct TextPiece {
  std::string text;  // bytes
  SourceRange range; // of exactly these bytes
};
struct HolePiece {
  Hole hole;
  SourceRange range;
};
using Piece = std::variant<TextPiece, HolePiece>;

// ---- parsed
// ------------------------------------------------------------------------------------------------

struct Expression;
using ExpressionPtr = std::unique_ptr<Expression>;

struct Number {
  std::string digits; // as written, without sign: "10", "0.5", "5."
  double value = 0;   // of the digits as written
  bool point = false;
};
struct VariableRef { // #5, #[..]
  ExpressionPtr number;
};
struct Negated {
  ExpressionPtr operand;
};
struct Operation { // + - * / MOD AND OR XOR
  std::string op;
  ExpressionPtr left, right;
};
struct FunctionCall { // SIN[..]; ATAN[y]/[x] has two arguments
  std::string name;
  std::vector<ExpressionPtr> arguments;
  bool bare = false;  // SIN#1: the argument is without brackets
  bool comma = false; // ATAN[y,x]
};
struct Expression {
  SourceRange range;
  std::variant<Number, Hole, VariableRef, Negated, Operation, FunctionCall> node;
  std::uint32_t brackets = 0; // pairs written around it, beyond those that are part of the node
};

struct Condition;
using ConditionPtr = std::unique_ptr<Condition>;

struct Comparison {
  std::string relation; // EQ NE GT LT GE LE
  ExpressionPtr left, right;
};
enum class Joint : std::uint8_t { Or, And, Xor };
struct Joined { // [..] AND [..]
  Joint joint = Joint::And;
  ConditionPtr left, right;
};
struct Condition {
  SourceRange range;
  std::variant<Comparison, Joined> node;
};

// A macro statement that steers the program.
struct Statement {
  // IfThen: the assignment of the block is what is done.
  enum class Kind : std::uint8_t { GoTo, If, IfThen, While, End };
  Kind kind = Kind::GoTo;
  SourceRange range;
  ConditionPtr condition;   // of If, IfThen, While; null: DO without a condition
  std::uint64_t number = 0; // GoTo, If: of the block to go on at; While, End: of the loop
};

struct Word {
  char address = 0;
  SourceRange range;
  ExpressionPtr value; // null: the address is bare
};
struct Assignment {       // #550=#138
  ExpressionPtr variable; // its number
  ExpressionPtr value;
  SourceRange range;
};
struct Comment {
  std::string text; // bytes between the brackets
  SourceRange range;
};

// POPEN, PCLOS, DPRNT[..] or BPRNT[..], alone in its block.
struct PortStatement {
  std::variant<ir::Port, ir::Print> node;
  SourceRange range;
};

struct Block {
  SourceRange range;
  bool blockDelete = false;
  std::optional<std::uint64_t> sequenceNumber;
  std::vector<Word> words;
  std::vector<Assignment> assignments;
  std::optional<Statement> statement;
  std::optional<PortStatement> port;
  std::vector<Comment> comments;
  bool programMark = false; // % alone
};

} // namespace dotek::frontend::nc
