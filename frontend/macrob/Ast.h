// Syntax tree of a file of Fanuc custom macro B. Words and expressions are those of frontend/nc, so that
// there is one tree for both ways to read a block (docs/macrob.md).
#pragma once

#include "frontend/nc/Block.h"
#include "support/Source.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace dotek::frontend::macrob {

using nc::Expression;
using nc::ExpressionPtr;

// ---- conditions
// ------------------------------------------------------------------------------------------------------------

struct Condition;
using ConditionPtr = std::unique_ptr<Condition>;

struct Comparison { // EQ NE GT GE LT LE
  std::string op;
  ExpressionPtr left, right;
};
struct JoinedConditions { // AND OR XOR
  std::string op;
  ConditionPtr left, right;
};
struct Condition {
  SourceRange range;
  std::variant<Comparison, JoinedConditions> node;
  std::uint32_t brackets = 0; // pairs around it; IF and WHILE demand one
};

// ---- statements
// ------------------------------------------------------------------------------------------------------------

struct Words { // NC statement; macro calls too (Calls.h)
  std::vector<nc::Word> words;
};

struct Goto {
  SourceRange range;
  ExpressionPtr target;
};

struct Port { // POPEN, PCLOS
  bool open = false;
};

// A piece of what DPRNT or BPRNT prints.
struct PrintedText {
  std::string text; // `*` prints as a blank
};
struct PrintedVariable { // #n[ab] of DPRNT, #n[b] of BPRNT
  std::uint32_t variable = 0;
  std::string format; // digits between the brackets
};
struct Print {
  bool binary = false; // BPRNT
  SourceRange range;   // of the text between the brackets
  std::vector<std::variant<PrintedText, PrintedVariable>> pieces;
};

struct SetNames { // SETVN 510[NAME,NAME]
  SourceRange range;
  std::uint32_t first = 0;
  std::vector<std::string> names;
};

// Number of a loop.
struct LoopNumber {
  SourceRange range;
  std::string digits;
  std::uint32_t value = 0; // UINT32_MAX: larger, or with a point
};
struct Do {
  SourceRange range;
  ConditionPtr condition; // null: DO without WHILE
  std::optional<LoopNumber> loop;
};
struct End {
  SourceRange range;
  std::optional<LoopNumber> loop;
};

// What THEN takes.
using ThenStatement = std::variant<nc::Assignment, Goto, Print, Port, SetNames>;
struct If {
  SourceRange range;
  ConditionPtr condition;
  bool then = false; // false: IF [..] GOTO n
  ThenStatement statement;
};

// A block that could not be read. Lint and dump go on; whatever runs or translates refuses.
struct Unread {
  SourceRange range;
  std::string text; // bytes
};

// std::monostate: nothing but a number or a comment.
using Body =
    std::variant<std::monostate, Words, nc::Assignment, Goto, If, Do, End, Print, Port, SetNames, Unread>;

// ---- blocks and programs
// ---------------------------------------------------------------------------------------------------

struct Comment {
  SourceRange range;
  std::string text; // bytes between the brackets
  // Words that precede it. Of a macro statement: 0 before it, 1 inside or after it.
  std::uint32_t place = 0;
};

struct BlockDelete {
  SourceRange range;
  std::optional<std::uint32_t> number; // the switch, 1 to 9
};

struct SequenceNumber {
  SourceRange range;
  std::string digits;
  std::uint64_t value = 0; // UINT64_MAX: not a whole number
};

struct Block {
  SourceRange range; // without its end; two lines where a comment or a block was broken
  std::optional<BlockDelete> blockDelete;
  std::optional<SequenceNumber> sequenceNumber;
  Body body;
  std::vector<Comment> comments; // in the order of the text
  // The tree is what the block most likely means: an error was reported, and its repair is taken as made.
  // What runs or translates refuses.
  bool repaired = false;
  bool target = false; // something goes to its number (Targets.h)
};

struct ProgramName {
  enum class Kind : std::uint8_t { Number, Colon, Name }; // O1234, :1234, <NAME>
  Kind kind = Kind::Number;
  SourceRange range;
  std::string text;         // digits, or the name
  std::uint64_t number = 0; // 0 of a name
};

struct Program {
  std::optional<ProgramName> name; // nothing: blocks before the first header
  std::vector<Comment> comments;   // on the line of the header
  std::vector<Block> blocks;       // blank lines are left out
  bool closed = false;             // `%` or the header of another program follows: the text is all of it
};

// All blocks, or of long stretches of plain moves only those that findings can depend on (Stretch.h).
enum class Keep : std::uint8_t { All, Summary };

// Plain moves that lint leaves out of the tree.
struct LeftOut {
  std::uint64_t blocks = 0;
  std::uint64_t lengths = 0; // their X, Y and Z other than 0, all with a point
};

struct File {
  FileId file = kNoFile;
  bool markFirst = false; // `%` before the first program
  bool markLast = false;  // `%` after the last
  SourceRange leader;     // text before the first `%`, which the control skips; empty: none
  std::vector<Program> programs;
  std::vector<SourceRange> legends; // text of drawings between the blocks, left out of the programs
  bool hasErrors = false;           // a block is unread or repaired, or limits cut something
  LeftOut leftOut;                  // by Keep::Summary
  // It would keep more than the limit: reported, and nothing was read.
  bool tooLarge = false;
};

} // namespace dotek::frontend::macrob
