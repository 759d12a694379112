// A control with its options, as data: stdlib/controls/<name>.toml (DESIGN 5).
#pragma once

#include "ir/Kind.h"
#include "ir/NcWords.h"

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace dotek::stdlib {

class DataFiles;

// How a number without a decimal point is read where the address counts a length or an angle.
enum class DecimalMode : std::uint8_t { Increment, Calculator };

// Addresses that count lengths, angles or seconds where a control does not list its own.
inline constexpr std::uint32_t kLengthAddresses = ir::addressBits("ABCIJKQRUVWXYZ");

// How macro statements compute. Decimal8: each result has eight significant decimal digits, is 0 or lies
// between 1e-29 and 1e47 in magnitude.
enum class Arithmetic : std::uint8_t { Double, Decimal8 };

// What a G or M function does, as far as Dotek translates it. X(id, name in the data)
#define DOTEK_FUNCTIONS(X)                                                                                   \
  X(Other, "other") /* known to the control, not translated: an opaque block */                              \
  X(Rapid, "rapid")                                                                                          \
  X(Feed, "feed")                                                                                            \
  X(ArcClockwise, "arc-clockwise")                                                                           \
  X(ArcCounterClockwise, "arc-counter-clockwise")                                                            \
  X(Dwell, "dwell")                                                                                          \
  X(Skip, "skip")                                                                                            \
  X(PlaneXY, "plane-xy")                                                                                     \
  X(PlaneZX, "plane-zx")                                                                                     \
  X(PlaneYZ, "plane-yz")                                                                                     \
  X(Inch, "inch")                                                                                            \
  X(Metric, "metric")                                                                                        \
  X(CutterCompOff, "cutter-comp-off")                                                                        \
  X(CutterCompLeft, "cutter-comp-left")                                                                      \
  X(CutterCompRight, "cutter-comp-right")                                                                    \
  X(ToolLengthPlus, "tool-length-plus")                                                                      \
  X(ToolLengthMinus, "tool-length-minus")                                                                    \
  X(ToolLengthOff, "tool-length-off")                                                                        \
  X(ScalingOn, "scaling-on")                                                                                 \
  X(ScalingOff, "scaling-off")                                                                               \
  X(MirrorOn, "mirror-on")                                                                                   \
  X(MirrorOff, "mirror-off")                                                                                 \
  X(PolarOn, "polar-on")                                                                                     \
  X(PolarOff, "polar-off")                                                                                   \
  X(LocalShift, "local-shift")                                                                               \
  X(SetPosition, "set-position") /* G92: the position gets these coordinates */                              \
  X(MachineCoordinates, "machine-coordinates")                                                               \
  X(WorkSystem, "work-system") /* G54 to G59: the code is the system */                                      \
  X(ExtendedWorkSystem, "extended-work-system")                                                              \
  X(DataInput, "data-input") /* G10 */                                                                       \
  X(ReferenceReturn, "reference-return")                                                                     \
  X(SecondReferenceReturn, "second-reference-return") /* 2nd, 3rd, 4th reference position */                 \
  X(MacroCall, "macro-call")                                                                                 \
  X(ModalCall, "modal-call") /* G66 */                                                                       \
  X(ModalCallOff, "modal-call-off")                                                                          \
  X(RotationOn, "rotation-on")                                                                               \
  X(RotationOff, "rotation-off")                                                                             \
  X(CannedCycle, "canned-cycle") /* ends at level R or at the initial level */                               \
  X(BackBoring, "back-boring")   /* ends at the initial level */                                             \
  X(CannedCycleOff, "canned-cycle-off")                                                                      \
  X(ReturnInitial, "return-initial") /* of canned cycles */                                                  \
  X(ReturnR, "return-r")                                                                                     \
  X(Absolute, "absolute")                                                                                    \
  X(Incremental, "incremental")                                                                              \
  X(FeedPerMinute, "feed-per-minute")                                                                        \
  X(FeedPerRevolution, "feed-per-revolution")                                                                \
  X(SurfaceSpeedOn, "surface-speed-on")                                                                      \
  X(SurfaceSpeedOff, "surface-speed-off")                                                                    \
  X(PathMode, "path-mode") /* how a path is followed or watched: no effect on where it ends */               \
  X(Stop, "stop")                                                                                            \
  X(OptionalStop, "optional-stop")                                                                           \
  X(ProgramEnd, "program-end")                                                                               \
  X(SpindleClockwise, "spindle-clockwise")                                                                   \
  X(SpindleCounterClockwise, "spindle-counter-clockwise")                                                    \
  X(SpindleOff, "spindle-off")                                                                               \
  X(CoolantMist, "coolant-mist")                                                                             \
  X(CoolantFlood, "coolant-flood")                                                                           \
  X(CoolantOff, "coolant-off")                                                                               \
  X(ToolChange, "tool-change")                                                                               \
  X(Auxiliary, "auxiliary") /* M: moves no axis, changes no modal state */                                   \
  X(ProbeOn, "probe-on")                                                                                     \
  X(ProbeOff, "probe-off")                                                                                   \
  X(SubprogramCall, "subprogram-call")                                                                       \
  X(Return, "return")                                                                                        \
  X(Thread, "thread")              /* of a lathe: straight, at the lead F */                                 \
  X(TurningCycle, "turning-cycle") /* the single cycles of a lathe: along Z, */                              \
  X(ThreadingCycle, "threading-cycle")                                                                       \
  X(FacingCycle, "facing-cycle")     /* along X */                                                           \
  X(ContourFinish, "contour-finish") /* G70 */                                                               \
  X(ContourRough, "contour-rough")   /* G71, G72, G73: from a contour given by P and Q */                    \
  X(PeckAlongZ, "peck-along-z")      /* G74 */                                                               \
  X(PeckAlongX, "peck-along-x")      /* G75 */                                                               \
  X(ThreadPasses, "thread-passes")   /* G76 */

enum class Function : std::uint8_t {
#define DOTEK_FUNCTION(id, name) id,
  DOTEK_FUNCTIONS(DOTEK_FUNCTION)
#undef DOTEK_FUNCTION
};
std::string_view functionName(Function function);

// Alarms of a control that Dotek raises. X(id, name in the data)
#define DOTEK_ALARMS(X)                                                                                      \
  X(TooManyDigits, "too-many-digits")                                                                        \
  X(NoFeed, "no-feed")                                                                                       \
  X(ArcRadius, "arc-radius") /* the end point does not lie on the arc */                                     \
  X(NoProgramNumber, "no-program-number")                                                                    \
  X(SubprogramDepth, "subprogram-depth")                                                                     \
  X(NoSuchProgram, "no-such-program")                                                                        \
  X(IntegerOverflow, "integer-overflow")                                                                     \
  X(Overflow, "overflow")                                                                                    \
  X(DivideByZero, "divide-by-zero")                                                                          \
  X(ImproperCommand, "improper-command")                                                                     \
  X(ExpressionFormat, "expression-format")                                                                   \
  X(NoSuchVariable, "no-such-variable")                                                                      \
  X(WriteProtected, "write-protected")                                                                       \
  X(BracketDepth, "bracket-depth")                                                                           \
  X(ArgumentRange, "argument-range")                                                                         \
  X(MacroDepth, "macro-depth")                                                                               \
  X(MissingEnd, "missing-end")                                                                               \
  X(StatementFormat, "statement-format")                                                                     \
  X(LoopNumber, "loop-number")                                                                               \
  X(MixedBlock, "mixed-block")                                                                               \
  X(NoSuchSequence, "no-such-sequence")                                                                      \
  X(GArgument, "g-argument")

enum class Alarm : std::uint8_t {
#define DOTEK_ALARM(id, name) id,
  DOTEK_ALARMS(DOTEK_ALARM)
#undef DOTEK_ALARM
};
std::string_view alarmName(Alarm alarm);

struct AlarmInfo {
  Alarm alarm{};
  std::uint32_t number = 0;
  std::string text; // as the control shows it
  std::string grade;
  std::string source;
};

struct CodeInfo {
  char letter = 'G';
  std::uint32_t tenths = 0; // code times ten: G54.1 is 541
  Function function = Function::Other;
  std::optional<int>
      group;         // modal group, same for codes that end each other; nothing: one-shot, or not known
  std::string title; // what lists print
  std::string grade; // "documented", "observed", "inferred", "assumed"
  std::string source;
};

// Where the control keeps its state; nothing: it has no such variable, or no source gives it.
struct SystemVariables {
  std::optional<int> modalFirst;  // of group 0: group g is at modalFirst + g
  std::optional<int> modalFeed;   // F in force
  std::optional<int> blockEnd;    // X of the end point of the previous block, work coordinates; Y, Z follow
  std::optional<int> machine;     // X of the machine position
  std::optional<int> position;    // X of the position, work coordinates
  std::optional<int> skip;        // X of the skip position, work coordinates
  std::optional<int> externalX;   // external work offset; the next axis is externalX + axisStep
  std::optional<int> workOffsetX; // X of G54
  std::optional<int> extendedX;   // X of G54.1 P1; the next axis is extendedX + axisStep
  int extendedStep = 0;           // from P1 to P2
  int extendedCount = 0;          // greatest P
  std::optional<int>
      toolWear; // of offset 0: offset n is at toolWear + n; the whole length where there is no geometry
  std::optional<int> toolGeometry;
  std::optional<int> toolWearToo; // second numbers of the same offsets, as toolWear and toolGeometry
  std::optional<int> toolGeometryToo;
  int toolCount = 0;                 // greatest offset number
  std::optional<int> modalWords;     // words in force: + 2 B, 7 D, 9 F, 11 H, 13 M, 14 N, 15 O, 19 S, 20 T
  std::optional<int> toolLength;     // X of the tool offset in force
  std::optional<int> alarm;          // #3000
  std::optional<int> timer;          // #3001, milliseconds
  std::optional<int> hours;          // #3002
  std::optional<int> message;        // #3006
  std::optional<int> extendedNumber; // #4130: P of the additional work system in force
  int systemStep = 0;                // from G54 to G55
  int axisStep = 0;                  // from X to Y
};

// Which positions along the tool's axis hold its length too, so that a program has to take it off.
struct LengthInPositions {
  bool position = false, skip = false; // of SystemVariables
  std::string grade;
  std::string source;
};

struct VariableRange {
  std::uint32_t first = 0, last = 0;
  bool kept = false; // at power off
};

// A code that calls a program: G5101, or as many codes one after the other as there are programs. Any T.
struct CallCode {
  char letter = 'G';
  std::uint32_t first = 0; // code; of T unused
  std::uint32_t count = 1;
  std::uint32_t program = 0;          // of the first code; the next code calls the next program
  bool macro = true;                  // with arguments and locals of its own; else as a subprogram
  std::optional<std::uint32_t> holds; // variable that gets the number after the letter
  std::string grade;
  std::string source;
};

// System variables that hold a value which Dotek keeps and does not otherwise follow.
struct StateRange {
  enum class Access : std::uint8_t {
    ReadOnly, // alarm 116 where a program writes it
    Store,    // a program may write it, and that is all that happens
    Effect,   // writing it changes what Dotek does not follow
  };
  std::uint32_t first = 0, last = 0;
  std::optional<std::uint32_t> word; // variable that holds these as bits, the first as the lowest
  Access access = Access::ReadOnly;
  bool null = false;             // always null
  std::optional<double> initial; // nothing: not known until it is set
  std::string title;
  std::string grade;
  std::string source;
};

// What parameters decide while G68 is on. Unknown: no source says it, and a run that depends on it ends.
struct RotationFacts {
  enum class Frame : std::uint8_t { Unknown, Work, Program };
  enum class Position : std::uint8_t { Unknown, Turned, AsBefore };
  Frame positions = Frame::Unknown; // of the end of a block, the position and the skip position
  // Where an axis of the plane is taken to be that the first absolute move after G68 does not name.
  Position otherAxis = Position::Unknown;
};

// Window into the memory of the machine's PMC; each is the number of a variable.
struct PmcWindow {
  std::string area; // "R"
  std::uint32_t bytes = 0;
  std::uint32_t address = 0, byte = 0, word = 0, doubleWord = 0; // a variable that is missing: 0
};

// What the control of a lathe has of its own.
struct TurningFacts {
  // The axis and the address of its increments: {'X', 'U'}. There are no modes of distance then.
  std::vector<std::pair<char, char>> increments;
  bool diameters = true;                 // X and its increment count diameters; I, K and R never do
  std::string axes;                      // in the order in which variables number them: #5041 is the first
  std::vector<std::uint32_t> startCodes; // G codes in force at power on, times ten, where not as on a mill
  std::uint32_t offsetDigits = 2;        // of T, the last ones: the number of the offset
  std::string grade;
  std::string source;

  // The axis whose increment the address is; 0: it is none.
  char axisOf(char increment) const;
  char incrementOf(char axis) const;
};

// The macros of a set as the maker of the control delivers them: the same calls, other variables.
struct MacroPackage {
  std::string set; // of the numbers that it is delivered with elsewhere
  std::string title;
  std::uint32_t shift = 0; // added to #100 to #149: inputs and results
  std::uint32_t calibrationFirst = 0,
                calibrationLast = 0;      // of the stylus, in place of #500 and the following
  std::uint32_t radiusX = 0, radiusY = 0; // of the ball, among them
  // Numbers of a work offset beyond G59 in a call, in place of those of the set; 0: none is known.
  double extendedFirst = 0, extendedLast = 0, extendedStep = 1;
};

struct Control {
  std::string name;   // of the file
  std::string title;  // what lists print
  std::string origin; // "built in", or the file
  DecimalMode decimal = DecimalMode::Calculator;
  std::string decimalGrade; // a grade, as of a code
  Arithmetic arithmetic = Arithmetic::Double;
  std::uint32_t lengths = kLengthAddresses; // ir::addressBit of each that counts lengths, angles or seconds
  double increment = 0.001;                 // mm, least input increment
  int decimals = 3;                         // most digits after the point of a word, mm
  int integerDigits = 5;                    // most digits before the point
  std::uint32_t digits = 8;                 // most digits of a number, leading zeros too
  bool ifThen = true;                       // IF [..] THEN statement
  bool joinedConditions = false;            // [[..] AND [..]]
  bool thenGoto = false;                    // IF [..] THEN GOTO n is known to run
  bool bareFunctions = false;               // ABS#1 without brackets is known to run
  std::uint32_t bracketDepth = 5;
  std::uint32_t locals = 33;
  std::uint32_t macroLevels = 4;
  std::vector<VariableRange> common;
  std::vector<VariableRange> readOnly; // system variables that no program writes (alarm 116)
  // Lengths and radii of tools, geometry and wear: all that the family may have, beyond what `variables`
  // says.
  std::vector<VariableRange> toolOffsets;
  // SIN, ATAN, AND, ...; beside ATAN the forms that exist: "ATAN[y]" (-90 to 90), "ATAN[y]/[x]", "ATAN[y,x]".
  std::set<std::string> functions;
  std::uint32_t alarmFirst = 0, alarmLast = 200; // n of #3000=n
  std::uint32_t alarmShown = 3000;               // what the control shows is this number + n
  std::uint32_t alarmLength = 26;                // characters of a message
  std::uint32_t programLast = 9999;              // greatest O number
  bool colonNames = false;                       // a program may be headed :12
  bool programNames = false;                     // a program may be headed <NAME>
  std::uint32_t sequenceLast = 9999;             // greatest N number of a GOTO
  SystemVariables variables;
  std::optional<LengthInPositions> withToolLength; // nothing: not known
  std::optional<double> arcTolerance; // mm, between the radii of an arc's ends; nothing: not known
  char repeatLetter = 0;              // of canned cycles; 0: not known
  char dwellLetter =
      'X'; // of G4 with seconds; P: seconds with a point, milliseconds without, and X is in no source
  RotationFacts rotation;
  std::optional<std::uint32_t>
      callDepth;                   // calls within calls, macros and subprograms together; nothing: not known
  bool repeatInProgram = false;    // M98 P51002 calls O1002 five times
  std::vector<CallCode> callCodes; // no code twice
  std::vector<std::pair<char, std::uint32_t>>
      readAheadStops;            // letter, code times ten, rising: wait for motion to end
  std::vector<StateRange> state; // no variable twice
  std::optional<PmcWindow> window;
  std::optional<MacroPackage> package; // nothing: sets have the numbers that their data states
  std::optional<bool> printPadding;    // DPRNT writes blanks for missing digits; nothing: not known
  std::vector<AlarmInfo> alarms;       // each alarm once
  std::vector<CodeInfo> codes;         // G and M, in the order of the file; each letter and code once
  std::optional<TurningFacts> turning; // nothing: a mill

  // The address counts a length, an angle or seconds.
  bool isLength(char letter) const { return ir::isAddressIn(lengths, letter); }
  // Its number counts least increments where it has no point. Words that mean something else in their block,
  // such as the repeats K of a canned cycle, are for the caller to tell apart.
  bool countsIncrements(char letter) const { return decimal == DecimalMode::Increment && isLength(letter); }

  const CodeInfo* find(char letter, std::uint32_t tenths) const; // nullptr: not in the table
  const CodeInfo* find(Function function) const;                 // the first with that meaning
  const AlarmInfo* find(Alarm alarm) const;                      // nullptr: its number is not known
  bool isCommon(std::uint32_t number) const;
  bool isReadOnly(std::uint32_t number) const;
  bool isToolOffset(std::uint32_t number) const;

  // Throws DataError where the file has a defect. nullopt: no such control.
  static std::optional<Control> load(const DataFiles& files, std::string_view name);
};

} // namespace dotek::stdlib
