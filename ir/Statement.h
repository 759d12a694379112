// Statements of the IR. A body is a flat list; labels and jumps are the base form of control flow. The
// statements of cycles and those of programs are two closed sets that share the kinds that both have
// (Nodes.def).
#pragma once

#include "ir/Expression.h"
#include "ir/Match.h"

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace dotek::ir {

// `value` in `frame`. Work: `system` is the G number of the work system, null pointer: the active one.
struct Coordinate {
  ExpressionPtr value;
  Frame frame = Frame::Work;
  ExpressionPtr system;
};

// variable = value. Parameters and hosts may be assigned, too: the source's macro may change its fields.
struct Assign {
  VariableId variable = 0;
  ExpressionPtr value;
};
// Writes a machine variable: #550 = value.
struct Store {
  ExpressionPtr number;
  ExpressionPtr value;
};
struct Label {
  LabelId label = 0;
};
struct Jump {
  LabelId target = 0;
};
// Jumps where the condition holds, else goes on.
struct Branch {
  ConditionPtr condition;
  LabelId target = 0;
};
// End of the cycle. Falling off the end of the body is the same.
struct Return {};

enum class Motion : std::uint8_t { Rapid, Feed, Protected };
// Straight move to the axes that are given; the others keep their position. A protected move stops with an
// alarm on contact.
struct Move {
  Motion motion = Motion::Rapid;
  std::array<std::optional<Coordinate>, 3> axes; // by Axis
  ExpressionPtr feed;                            // mm/min; null pointer: the one in force
  ProbePoint point = ProbePoint::Centre;
};

// The system gets, along each measured axis that has a nominal, the zero that gives the measured point the
// coordinate `nominal`.
struct OffsetSetting {
  ExpressionPtr system;                 // G number, 54 to 59
  std::array<ExpressionPtr, 3> nominal; // by Axis; null pointer: axis not set
};
enum class Feature : std::uint8_t { Surface, Bore };
// Touches a feature and returns to where it began.
struct Measure {
  Feature feature = Feature::Surface;
  Axis axis = Axis::X;                  // of a surface
  std::optional<Coordinate> target;     // of a surface: expected contact point along `axis`, signed
  ExpressionPtr diameter;               // of a bore; its expected centre is where the probe is
  std::optional<OffsetSetting> setting; // nothing: only measures
};

struct ProbePower {
  bool on = true;
};
struct Spindle {
  enum class State : std::uint8_t { Off, Clockwise, CounterClockwise };
  State state = State::Off;
  ExpressionPtr speed; // rev/min; null pointer: not stated
};
struct Coolant {
  enum class State : std::uint8_t { Off, Flood, Mist };
  State state = State::Off;
};
// A modal function without motion: G90, G54, G94. `system` for WorkSystem: its G number, may be computed.
enum class Mode : std::uint8_t {
  Absolute,
  Incremental,
  FeedPerMinute,
  FeedPerRevolution,
  PlaneXY,
  PlaneZX,
  PlaneYZ,
  CutterCompOff,
  CannedCycleOff,
  WorkSystem,
  RapidMotion,
  FeedMotion
};
struct SetMode {
  Mode mode = Mode::Absolute;
  ExpressionPtr system;
};
struct Dwell {
  ExpressionPtr seconds;
};
// Waits for the operator (M0, M1).
struct Stop {
  bool optional = false;
  std::string message; // UTF-8
  double number = 1;   // of the message: n of #3006=n
};
// Ends the program with a message.
struct Alarm {
  std::string message; // UTF-8; "" where the source gives none
};
struct Comment {
  std::string text; // UTF-8, without the target's brackets
};
// An argument of a CallCycle, by the name of the parameter that it fills.
struct CycleArgument {
  std::string parameter;      // of the cycle, its axis included: "depth", "target x"
  ExpressionPtr value;        // never a null pointer
  std::optional<Frame> frame; // of a coordinate: Work (the active system) or Here; nothing: it is none
  Kind kind = Kind::Number;
  bool moves = true; // the probe moves by it; else it checks, prints or corrects
};
// The work offset that a cycle sets.
struct CycleSetting {
  ExpressionPtr system;       // G number, 54 to 59
  std::array<bool, 3> axes{}; // by Axis: offsets that change
  // By Axis: what the feature gets as its coordinate; null pointer: where it is expected, that is the target
  // along the axis, or, where there is none, the place of the probe.
  std::array<ExpressionPtr, 3> nominal;
};
// Carries out a probing cycle by its name. What the cycle consists of says who defines it: a macro set, by
// its signature.
struct CallCycle {
  std::string cycle;        // "web", "three-point-bore"
  std::optional<Axis> axis; // along which it measures, of a cycle that is there for each axis
  std::string set; // macro set that the source calls: what the name leaves open is as that set has it
  std::vector<CycleArgument> arguments; // in the order of the source, the work system aside
  std::optional<CycleSetting> setting;
  std::optional<bool> power;       // it switches the probe
  std::vector<ResultName> results; // that it leaves
  bool moves = true;               // the probe moves
  bool returns = true;             // to where it began; else its place is unknown afterwards
  bool setsTool = false;           // a tool offset may change
};
// A word of an opaque block: address and number, or address and expression.
struct Word {
  char address = 0;
  ExpressionPtr value;
  SourceRange range;
};
// A block whose meaning is not known: read as words, copied to the source's own control only. It is taken to
// change every modal group and the position.
struct OpaqueBlock {
  std::vector<Word> words;
};

// ---- of programs only (Program.h): what the macro language of a control adds ------------------------------

// A block as the control reads it, words in the order of the text. A word whose value is null is left out.
struct NcBlock {
  std::vector<Word> words; // a value is never a null pointer
};
// GOTO with a computed number, rounded: to the nearest block that has it, forward from here and then from the
// first block of the program. None: an alarm.
struct JumpTo {
  ExpressionPtr number;
};
// WHILE and DO. Goes on where the condition holds, else at `end`, which follows the LoopEnd.
struct Loop {
  std::uint32_t number = 1; // 1 to 3
  ConditionPtr condition;   // null pointer: for ever
  LabelId end = 0;
};
// END: goes on at `begin`, which precedes the Loop.
struct LoopEnd {
  std::uint32_t number = 1;
  LabelId begin = 0;
};
enum class CallKind : std::uint8_t {
  Macro,      // G65: a level of locals of its own
  AfterMoves, // G66: after each later block that moves an axis
  EachBlock,  // G66.1: in the place of each later block, whose words are the arguments
  Off,        // G67: ends the last G66 or G66.1
  Subprogram, // M98: the locals of the caller
};
struct CallArgument {
  char letter = 0;
  std::uint32_t local = 0; // #n that it sets; of two that set one the later holds
  ExpressionPtr value;     // null at run time: the local stays null
  SourceRange range;
};
struct Call {
  CallKind kind = CallKind::Macro;
  ExpressionPtr program;               // P, rounded; null pointer: Off, or no P
  ExpressionPtr repeats;               // L; null pointer: once
  std::vector<CallArgument> arguments; // of Macro and AfterMoves, in the order of the text
};
// M99. In the main program: goes on at its first block.
struct Exit {
  ExpressionPtr block; // P: N number in the caller to go on at; null pointer: after the call
};
// #3000 = number (text): ends the run.
struct Raise {
  ExpressionPtr number;
  std::string text; // bytes of the source
};
// #3006 = number (text): waits for the operator.
struct Notice {
  ExpressionPtr number;
  std::string text; // bytes of the source
};
// POPEN, PCLOS.
struct Port {
  bool open = false;
};
// DPRNT and BPRNT: texts and variables, in order.
struct PrintPiece {
  std::string text;                    // bytes as printed, a `*` of the source is a blank
  std::optional<std::uint32_t> number; // a variable instead of text
  std::uint32_t integerDigits = 0;     // DPRNT
  std::uint32_t decimals = 0;
};
struct Print {
  bool binary = false; // BPRNT
  std::vector<PrintPiece> pieces;
};
// SETVN: names of common variables from `first` on.
struct NameVariables {
  std::uint32_t first = 0;
  std::vector<std::string> names;
};

// Where a statement of a program comes from.
struct BlockOrigin {
  std::vector<SourceRange> ranges; // first: what messages point at
  std::string reason;              // "" or what made it: "argument omitted", "mode restored"
  std::uint32_t block = 0;         // statements lifted from one NC block share a number; 0: from none
  std::uint32_t place = 0; // of a Comment of a program: words of its block that precede it, layout only

  SourceRange range() const { return ranges.empty() ? SourceRange{} : ranges.front(); }
};
// Where a statement of a cycle comes from, and what keeps the look of the source.
struct Origin : BlockOrigin {
  std::string addresses; // letters of its NC block in the order written
  // Letters of a macro call that a variable fills directly: they name the arguments of the result.
  std::vector<std::pair<char, VariableId>> arguments;
};

// The variant of what follows a first type, which lets each line of Nodes.def begin with its comma.
template <class, class... Kinds> struct KindsOf { using Variant = std::variant<Kinds...>; };

#define DOTEK_COMMON_STATEMENT(Type, text) , Type
struct CycleStatement {
  KindsOf<void
#define DOTEK_CYCLE_STATEMENT(Type, text) , Type
#include "ir/Nodes.def"
#undef DOTEK_CYCLE_STATEMENT
          >::Variant node;
  Origin origin;
};

struct ProgramStatement {
  KindsOf<void
#define DOTEK_PROGRAM_STATEMENT(Type, text) , Type
#include "ir/Nodes.def"
#undef DOTEK_PROGRAM_STATEMENT
          >::Variant node;
  BlockOrigin origin;
  // 0: always carried out; 1 to 9: passed over where this switch of block delete is on.
  std::uint8_t blockDelete = 0;
};
#undef DOTEK_COMMON_STATEMENT

// What analyses of both take.
template <class Type>
concept AnyStatement = OneOf<Type, CycleStatement, ProgramStatement>;

} // namespace dotek::ir
