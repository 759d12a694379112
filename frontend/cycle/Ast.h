// Syntax tree of a `.cycle` file. Keeps what the author wrote: comments, blank lines, digits. Broken parts
// are ErrorStatement and Missing.
#pragma once

#include "support/Source.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace dotek::frontend::cycle {

// "text" between quotes; UTF-8.
struct Text {
  SourceRange range;
  std::string text;
};

struct Name {
  SourceRange range;
  std::string text;
};

enum class Unit : std::uint8_t {
  None, // a count or a ratio
  Millimetre,
  Inch,
  Degree,
  MillimetrePerMinute,
  InchPerMinute,
  Second
};
// "mm", "in", "deg", "mm/min", "in/min", "s"; "" for None.
std::string_view unitText(Unit unit);

enum class Axis : std::uint8_t { X, Y, Z, A, B, C };
char axisLetter(Axis axis);

struct Expression;
using ExpressionPtr = std::unique_ptr<Expression>; // never null unless a member says so

struct Number {
  std::string digits; // with a decimal point, whatever the author wrote
  double value = 0;   // in the unit as written
  Unit unit = Unit::None;
};
// A parameter, result, variable, host value or choice.
struct NameUse {
  std::string name;
};
// right.at, start.x, hole.size
struct Member {
  Name object;
  Name member;
};
// G54 to G59; `extended` is the number after G54.1 P, 0: none.
struct WorkOffset {
  std::uint32_t number = 54;
  std::uint32_t extended = 0;
};
enum class UnaryOp : std::uint8_t { Negate, Not };
struct Unary {
  UnaryOp op = UnaryOp::Negate;
  ExpressionPtr operand;
};
enum class BinaryOp : std::uint8_t {
  Add,
  Subtract,
  Multiply,
  Divide,
  Less,
  LessEqual,
  Greater,
  GreaterEqual,
  Is,
  IsNot,
  And,
  Or
};
std::string_view operatorText(BinaryOp op);
struct Binary {
  BinaryOp op = BinaryOp::Add;
  ExpressionPtr left, right;
};
// abs(a), atan(y, x)
struct Function {
  Name name;
  std::vector<ExpressionPtr> arguments;
};
// given NAME: the caller has given the optional parameter.
struct Given {
  Name name;
};
// In brackets as written.
struct Bracketed {
  ExpressionPtr inner;
};
// What could not be read; reported.
struct Missing {};

struct Expression {
  SourceRange range;
  std::variant<Missing, Number, NameUse, Member, WorkOffset, Text, Unary, Binary, Function, Given, Bracketed>
      node;
};

// ---- statements ------------------------------------------------------------------------------------------

struct Statement;
// `//` to the end of its line.
struct Comment {
  SourceRange range;
  std::string text;         // after the slashes, blanks at its end taken off
  bool blankBefore = false; // an empty line is above it
};
struct Block {
  std::vector<Statement> statements;
  std::vector<Comment> comments; // after the last statement
};

struct File;
// cycle NAME "title"; options NAME "title"
struct Header {
  bool options = false; // parameters and results that cycles share, and nothing that runs
  Name name;
  std::optional<Text> title;
};
// use NAME: what a file of options declares
struct Use {
  Name name;
  const File* options = nullptr; // by link(); nullptr: there is none, or the tree is not linked
};
// needs probe: the caller has switched the probe on.
struct Needs {};

enum class TypeName : std::uint8_t {
  Length,
  Angle,
  Feed,
  Time,
  Count,
  Ratio,
  Flag,
  Text,
  Choice,
  WorkOffset,
  ToolOffset
};
std::string_view typeText(TypeName type);

struct Type {
  SourceRange range;
  TypeName name = TypeName::Length;
  std::vector<Name> choices; // of Choice
};
// What follows the title of a parameter or result.
struct Clause {
  enum class Kind : std::uint8_t { Require, Range, Group, Letter, Picture };
  SourceRange range;
  Kind kind = Kind::Require;
  ExpressionPtr first;      // the condition, or the least value; null pointer: Group, Letter, Picture
  ExpressionPtr second;     // the largest value; null pointer: of the other kinds
  std::optional<Text> text; // the message, group or picture
  std::optional<Name> letter;
};
struct Parameter {
  std::vector<Name> names;
  Type type;
  bool optional = false;
  ExpressionPtr value; // the default; null pointer: none
  std::optional<Text> title;
  std::vector<Clause> clauses;
};
struct Result {
  std::vector<Name> names;
  Type type;
  std::optional<Text> title;
};
// require CONDITION "message": before anything moves.
struct Require {
  ExpressionPtr condition;
  std::optional<Text> message;
};

struct ProbeSwitch {
  bool on = true;
};
struct SpindleOff {};
struct Coolant {
  enum class State : std::uint8_t { Off, Flood, Mist };
  State state = State::Off;
};
struct Dwell {
  ExpressionPtr time;
};
struct Stop {
  Text text;
};
struct Alarm {
  Text text;
};
// report "name" nominal E measured E tolerance E
struct Report {
  Text name;
  ExpressionPtr nominal; // null pointer: not stated
  ExpressionPtr measured;
  ExpressionPtr tolerance; // null pointer: not stated
};

// x E, machine z E, work G55 x E
struct Coordinate {
  enum class Frame : std::uint8_t { Active, Machine, Work };
  SourceRange range;
  Frame frame = Frame::Active;
  ExpressionPtr system; // of Work; null pointer: of the others
  Axis axis = Axis::X;
  ExpressionPtr value;
};
enum class Reach : std::uint8_t { To, By };
struct Move {
  enum class Kind : std::uint8_t { Rapid, Feed, Protected };
  Kind kind = Kind::Rapid;
  bool kindSaid = false; // `move` alone is a rapid
  bool toStart = false;  // move to start
  Reach reach = Reach::To;
  std::vector<Coordinate> axes;
  ExpressionPtr feed; // null pointer: not stated
};
// touch [once] AXIS by E [overtravel E] -> NAME [else .. end];  touch along x E, y E by E -> NAME
struct Touch {
  bool once = false;
  Axis axis = Axis::X;
  std::vector<Coordinate> along; // of a direction; empty: along `axis`
  Reach reach = Reach::By;
  ExpressionPtr value;
  ExpressionPtr overtravel; // null pointer: the host's
  std::optional<Name> name;
  std::unique_ptr<Block> otherwise; // nothing found; null pointer: an alarm
};
// set SYSTEM: VALUE becomes AXIS COORDINATE, ...
struct Becomes {
  ExpressionPtr value;
  Axis axis = Axis::X;
  ExpressionPtr coordinate;
};
struct SetOffset {
  ExpressionPtr system;
  std::vector<Becomes> items;
};
// Of a tool offset: what `set tool` sets, and T.length reads.
enum class ToolPart : std::uint8_t { Length, LengthWear, Radius, RadiusWear };
std::string_view toolPartText(ToolPart part); // "length_wear"
std::optional<ToolPart> toolPartOf(std::string_view text);
// set tool T length E
struct SetTool {
  ExpressionPtr tool;
  ToolPart part = ToolPart::Length;
  ExpressionPtr value;
};
// set stored NAME E: for a later run
struct SetStored {
  Name name;
  ExpressionPtr value;
};
struct Assign {
  Name name;
  ExpressionPtr value;
};
struct If {
  struct Part {
    ExpressionPtr condition;
    Block body;
    std::vector<Comment> comments; // before its `else if`
  };
  std::vector<Part> parts;          // if, else if, ...
  std::unique_ptr<Block> otherwise; // null pointer: no else
  std::vector<Comment> elseComments;
};
// repeat N times
struct Repeat {
  ExpressionPtr count;
  Block body;
};
// for NAME = E to E [step E]
struct For {
  Name name;
  ExpressionPtr first, last;
  ExpressionPtr step; // null pointer: 1
  Block body;
};
// while CONDITION at most N times
struct While {
  ExpressionPtr condition;
  ExpressionPtr most;
  Block body;
};
struct Argument {
  Name name;
  ExpressionPtr value;
};
// call CYCLE name = E, ..., use OPTIONS -> NAME
struct Call {
  Name cycle;
  std::vector<Argument> arguments;
  std::vector<Name> uses; // options of the caller that are handed on; printed after the arguments
  std::optional<Name> result;
  // By link(), not written in the text:
  const File* called = nullptr;   // nullptr: there is none, or the tree is not linked
  std::vector<Argument> handedOn; // the parameters of `uses`: the caller's of the same name as values
};
struct ErrorStatement {};

struct Statement {
  SourceRange range;
  bool blankBefore = false; // an empty line is above it, or above the comments before it
  std::vector<Comment> before;
  std::optional<Comment> after; // on its last line; of a block, on its first
  std::variant<ErrorStatement, Header, Use, Needs, Parameter, Result, Require, ProbeSwitch, SpindleOff,
               Coolant, Dwell, Stop, Alarm, Report, Move, Touch, SetOffset, SetTool, SetStored, Assign, If,
               Repeat, For, While, Call>
      node;
};

struct File {
  FileId file = kNoFile;
  Block body; // the header is the first statement of a sound file
  bool hasErrorNodes = false;

  // nullptr: there is none.
  const Header* header() const;
};

} // namespace dotek::frontend::cycle
