// A vendor's pack of probing macros, as data: what each call means (stdlib/macros/<name>.toml).
#pragma once

#include "ir/Expression.h"
#include "ir/Kind.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dotek::stdlib {

class DataFiles;

// What a call does. X(id, name in the data)
#define DOTEK_INTENTS(X)                                                                                     \
  X(ProtectedMove, "protected-move")                                                                         \
  X(Surface, "surface")                                                                                      \
  X(Bore, "bore")                                                                                            \
  X(Boss, "boss")                                                                                            \
  X(Pocket, "pocket")                                                                                        \
  X(Web, "web")                                                                                              \
  X(InnerCorner, "inner-corner")                                                                             \
  X(OuterCorner, "outer-corner")                                                                             \
  X(Angle, "angle")                                                                                          \
  X(AngledSurface, "angled-surface")                                                                         \
  X(AngledPocket, "angled-pocket")                                                                           \
  X(AngledWeb, "angled-web")                                                                                 \
  X(ThreePointBore, "three-point-bore")                                                                      \
  X(ThreePointBoss, "three-point-boss")                                                                      \
  X(BoltCircle, "bolt-circle")                                                                               \
  X(StockAllowance, "stock-allowance")                                                                       \
  X(FeatureToFeature, "feature-to-feature")                                                                  \
  X(ToolUpdate, "tool-update")                                                                               \
  X(Calibration, "calibration")                                                                              \
  X(ProbeOn, "probe-on")                                                                                     \
  X(ProbeOff, "probe-off")

enum class Intent : std::uint8_t {
#define DOTEK_INTENT(id, name) id,
  DOTEK_INTENTS(DOTEK_INTENT)
#undef DOTEK_INTENT
};
std::string_view intentName(Intent intent);

// How the data state the axis of a role: not at all, always, where the feature lies along one.
enum class AxisUse : std::uint8_t { None, Needed, Possible };

// What an argument means. X(id, name in the data, kind, axis, chooses a thing instead of measuring one)
#define DOTEK_ROLES(X)                                                                                       \
  X(Target, "target", Length, Needed, false) /* coordinate to reach or to find, along `axis` */              \
  X(Feed, "feed", Feed, None, false)                                                                         \
  X(Diameter, "diameter", Length, None, false)     /* expected */                                            \
  X(Nominal, "nominal", Length, Needed, false)     /* coordinate that the feature gets in the system set */  \
  X(System, "system", WorkOffset, None, true)      /* work offset to set */                                  \
  X(Width, "width", Length, Possible, false)       /* expected */                                            \
  X(Depth, "depth", Length, None, false)           /* Z at which is probed, work coordinates */              \
  X(Clearance, "clearance", Length, None, false)   /* beside the surface on the way down; < 0: within */     \
  X(Overtravel, "overtravel", Length, None, false) /* how far beyond the expected surface is probed */       \
  X(FlagOnly, "flag-only", Flag, None, true)       /* 1: a flag instead of an alarm */                       \
  X(Tool, "tool", ToolOffset, None, true)          /* tool offset to correct */                              \
  X(SpareTool, "spare-tool", ToolOffset, None, true)  /* offset that adds up what is averaged */             \
  X(Experience, "experience", ToolOffset, None, true) /* offset whose value is added to the size */          \
  X(SizeTolerance, "size-tolerance", Length, None, false)                                                    \
  X(PositionTolerance, "position-tolerance", Length, None, false) /* diameter of the zone */                 \
  X(AngleTolerance, "angle-tolerance", Angle, None, false)                                                   \
  X(UpperLimit, "upper-limit", Length, None, false) /* of the error; beyond it nothing is set */             \
  X(NullBand, "null-band", Length, None, false)     /* no tool is corrected below */                         \
  X(Feedback, "feedback", Ratio, None, false)       /* share of the error that corrects the tool */          \
  X(Print, "print", Count, None, true)              /* 1: next feature, 2: next part */                      \
  X(Spacing, "spacing", Length, Needed, false)      /* to the second touch of a face */                      \
  X(FaceAngle, "face-angle", Angle, None, false)    /* expected, from +X */                                  \
  X(Direction, "direction", Angle, None, false)     /* of the touch, from +X */                              \
  X(Distance, "distance", Length, None, false)      /* from the start to the expected surface */             \
  X(FirstAngle, "first-angle", Angle, None, false)  /* directions of three touches */                        \
  X(SecondAngle, "second-angle", Angle, None, false)                                                         \
  X(ThirdAngle, "third-angle", Angle, None, false)                                                           \
  X(PitchDiameter, "pitch-diameter", Length, None, false)                                                    \
  X(StartAngle, "start-angle", Angle, None, false)                                                           \
  X(Number, "number", Count, None, true)       /* of holes, of parts */                                      \
  X(Point, "point", Length, Needed, false)     /* of further touches; the letter may be repeated */          \
  X(Task, "task", Count, None, true)           /* what is calibrated */                                      \
  X(Unstated, "unstated", Number, None, false) /* a letter of the call; no source says what it is */

enum class ArgumentRole : std::uint8_t {
#define DOTEK_ROLE(id, name, kind, axis, selector) id,
  DOTEK_ROLES(DOTEK_ROLE)
#undef DOTEK_ROLE
};
std::string_view roleName(ArgumentRole role);

// How a work system is written in a System argument.
enum class SystemCode : std::uint8_t {
  GNumber, // "g-number": 56 is G56
  Index,   // "index": 1 to 6 are G54 to G59
};
// What a System argument does with the offset.
enum class SystemRule : std::uint8_t {
  Nominal, // "nominal": the feature gets the coordinate of the Nominal argument
  Error,   // "error": new value = offset in force + measured minus expected; the target is the nominal
};

struct MacroArgument {
  char letter = 0;
  ArgumentRole role = ArgumentRole::Target;
  ir::Axis axis = ir::Axis::X;       // where the role has one
  ir::Frame frame = ir::Frame::Work; // of Target: Work (absolute, active system) or Here (signed travel)
  ir::Kind kind = ir::Kind::Length;
  bool selector = false; // chooses, does not measure: its digits are no length
  bool point = true;     // written with a decimal point
  bool required = false;
  bool positive = false; // the macro takes values above 0 alone; a clearance below 0 is an island elsewhere
  SystemCode systemCode = SystemCode::GNumber;
  SystemRule systemRule = SystemRule::Nominal;
  // Of an Index: numbers beside 1 to 6 that stand for G54.1 P1 and following, a step apart; 0: none.
  double extendedFirst = 0, extendedLast = 0, extendedStep = 1;
  std::string unknown; // what no source says of it: a run by meaning that meets it is inconclusive
};

// The n of G54.1 Pn that a number of the argument stands for; 0: it names none.
std::uint32_t extendedSystem(const MacroArgument& argument, double number);
// The number that stands for G54.1 Pn.
double extendedNumber(const MacroArgument& argument, std::uint32_t n);

// What a variable holds after the call. X(id, name in the data)
#define DOTEK_OUTPUTS(X)                                                                                     \
  X(Main, "main") /* no document describes it */                                                             \
  X(PositionX, "position-x")                                                                                 \
  X(PositionY, "position-y")                                                                                 \
  X(PositionZ, "position-z")                                                                                 \
  X(Size, "size")                                                                                            \
  X(Angle, "angle")    /* of a face; of a corner: of its X face */                                           \
  X(AngleY, "angle-y") /* of the Y face of a corner */                                                       \
  X(ErrorX, "error-x")                                                                                       \
  X(ErrorY, "error-y")                                                                                       \
  X(ErrorZ, "error-z")                                                                                       \
  X(SizeError, "size-error")                                                                                 \
  X(AngleError, "angle-error")                                                                               \
  X(AngleErrorY, "angle-error-y")                                                                            \
  X(TruePosition, "true-position")                                                                           \
  X(MetalCondition, "metal-condition")                                                                       \
  X(TouchDirection, "direction")                                                                             \
  X(Hole, "hole")                                                                                            \
  X(Maximum, "maximum")                                                                                      \
  X(Variation, "variation")                                                                                  \
  X(OutOfTolerance, "out-of-tolerance") /* 0, or what was exceeded */                                        \
  X(ProbeError, "probe-error")          /* 0: none */

enum class Output : std::uint8_t {
#define DOTEK_OUTPUT(id, name) id,
  DOTEK_OUTPUTS(DOTEK_OUTPUT)
#undef DOTEK_OUTPUT
};
std::string_view outputName(Output output);

struct MacroResult {
  Output output = Output::Main;
  std::optional<ir::ResultName> name; // of the outputs that the IR has
  std::uint32_t variable = 0;
  bool documented = true; // what it holds is known; never with Main
  // Of one that is not documented: what a run by meaning puts there, and says so; nothing: it is not known
  // then.
  std::optional<Output> taken;
};

// One reading of a call. A program that measures in several ways has one signature for each.
struct MacroSignature {
  std::uint32_t program = 0; // P
  std::string title;         // "single surface along X"
  Intent intent = Intent::ProtectedMove;
  std::vector<MacroArgument> arguments; // in the order in which they are written
  // At least one of these letters is in the call; empty: no such rule.
  std::string anyOf;
  std::vector<MacroResult> results;
  std::string unknown; // what no source says of the call: a run by meaning is inconclusive; "": nothing
  std::string grade;
  std::string source;

  const MacroArgument* find(char letter) const;
  // `axis` aside for roles that state none.
  const MacroArgument* find(ArgumentRole role, ir::Axis axis = ir::Axis::X) const;
  const MacroResult* find(Output output) const;
  // All letters are arguments, and none that is required is missing.
  bool fits(std::string_view letters) const;
};

// Letters that exclude each other.
struct RefusedLetters {
  std::vector<std::uint32_t> programs;
  std::string letters; // all of them together
  std::string text;    // of the alarm; "" where no source gives it
};

// Alarms of the macros. X(id, name in the data)
#define DOTEK_MACRO_ALARMS(X)                                                                                \
  X(PathObstructed, "path-obstructed")                                                                       \
  X(NoFeed, "no-feed")                                                                                       \
  X(ProbeOpen, "probe-open")                                                                                 \
  X(ProbeFail, "probe-fail")                                                                                 \
  X(OutOfTolerance, "out-of-tolerance")                                                                      \
  X(OutOfPosition, "out-of-position")                                                                        \
  X(OutOfAngle, "out-of-angle")                                                                              \
  X(UpperLimit, "upper-limit")

enum class MacroAlarm : std::uint8_t {
#define DOTEK_MACRO_ALARM(id, name) id,
  DOTEK_MACRO_ALARMS(DOTEK_MACRO_ALARM)
#undef DOTEK_MACRO_ALARM
};
std::string_view macroAlarmName(MacroAlarm alarm);

struct MacroAlarmInfo {
  MacroAlarm alarm{};
  std::optional<std::uint32_t> number; // n of #3000 = n; nothing: not known
  std::string text;
};

// What a run by meaning needs beside the signatures; nothing: no source gives it.
struct ProbingFacts {
  std::optional<double> overtravel, overtravelZ;        // without the argument, mm; Z: where it differs
  std::optional<double> clearance;                      // without the argument, mm
  std::optional<std::uint32_t> feedVariable;            // keeps the feed of protected moves
  std::optional<std::uint32_t> radiusX, radiusY;        // of the calibrated stylus
  std::optional<std::uint32_t> offsetX, offsetY;        // of the ball to the spindle's axis
  std::optional<std::uint32_t> vectorFirst, vectorLast; // radii by direction
  bool lengthToTip = true;                              // the tool's length ends at the ball's lowest point
  enum class ToolRegister : std::uint8_t { Unknown, Wear, Geometry };
  ToolRegister toolLength = ToolRegister::Unknown; // what a tool argument corrects
};

struct MacroSet {
  std::string name; // of the file
  std::string title;
  std::string origin;
  std::vector<MacroSignature> signatures; // in the order of the file
  // Variables that the macros overwrite: nothing of the caller is kept there across a call.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> scratch;
  // Those of them that every call is known to overwrite.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> overwritten;
  std::vector<RefusedLetters> refused;
  std::vector<MacroAlarmInfo> alarms; // each once
  ProbingFacts probing;
  std::string needs; // what is set before the first call, as a program's header says it; "": nothing
  // Variables of what is needed with values that do, for runs in which nobody sets them: number and value.
  std::vector<std::pair<std::uint32_t, double>> callerValues;
  bool needsSkipPosition = false; // the macros read the skip position of the control

  bool calls(std::uint32_t program) const;
  // The macros read the calibration of the stylus there. What they work in lies below, also where the control
  // keeps it at power off.
  bool keepsCalibration(std::uint32_t variable) const;
  // Whether there are calls whose work no source states.
  bool hasUnstated() const;
  // Signatures of the program.
  std::vector<const MacroSignature*> of(std::uint32_t program) const;
  // The signature for an intent; of a surface, an angle, a pocket and a web the one along `axis`. nullptr:
  // the set has none.
  const MacroSignature* find(Intent intent, ir::Axis axis = ir::Axis::X) const;
  const MacroAlarmInfo* find(MacroAlarm alarm) const;

  static std::optional<MacroSet> load(const DataFiles& files, std::string_view name);
};

struct MacroPackage;
// The set as the control has it (Control::package): the same name and calls, its variables moved. Work
// offsets by an extended number are none of its letters, as the package codes them otherwise.
MacroSet packaged(const MacroSet& set, const MacroPackage& package);

// #n that a letter of G65 sets, argument specification I; 0: the letter is no argument.
std::uint32_t localOf(char letter);
// The letter that sets #n; 0: none does.
char letterOfLocal(std::uint32_t local);

} // namespace dotek::stdlib
