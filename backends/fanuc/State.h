// What the parts of the back end share while they write one program.
#pragma once

#include "backends/common/NamedSystems.h"
#include "backends/fanuc/Emit.h"
#include "backends/fanuc/Sheet.h"
#include "ir/Evaluate.h"
#include "ir/Positions.h"

#include <set>
#include <string_view>

namespace dotek::backends::fanuc {

// Locals for own values: first those that no letter can reach, then those that this program's letters leave.
class Locals {
public:
  Locals(std::uint32_t count, const std::vector<Argument>& arguments);
  // Variables of the machine in the place of locals, the first is taken first.
  explicit Locals(const std::vector<std::uint32_t>& variables)
      : free_(variables.rbegin(), variables.rend()) {}
  // 0: none is left.
  std::uint32_t take();
  std::size_t left() const { return free_.size(); }

private:
  std::vector<std::uint32_t> free_; // the last is taken next
};

// Whether a state of the machine may be in force when the program runs.
enum class Guard : std::uint8_t {
  Absent,    // the control has no such function
  Checked,   // an alarm at entry
  Unchecked, // no variable tells
};

struct Guards {
  Guard metric = Guard::Unchecked, rotation = Guard::Unchecked, scaling = Guard::Unchecked;
  Guard cutterComp = Guard::Unchecked, cannedCycle = Guard::Unchecked, toolLength = Guard::Unchecked;
  Guard extended = Guard::Unchecked; // extended work systems
  Guard shift = Guard::Unchecked;    // local shift
};

// An alarm of ours or of the source.
struct AlarmText {
  std::uint32_t number = 0;
  std::string shown; // what the control shows; "": its number alone, as in the source
  std::string full;  // "" where `shown` says all
};

// What holds before each statement of the body.
enum class Distance : std::uint8_t { Unknown, Absolute, Incremental };
struct Body {
  std::vector<ir::Position> positions;
  std::vector<const ir::CycleStatement*> last; // Measure or CallCycle
  std::vector<Distance> distance;
  std::vector<bool> feed; // stated since the beginning, and since the last call of a macro
  // An offset was set since entry: the start point is no coordinate of the active system any more.
  std::vector<std::array<bool, 3>> staleStart;
  std::map<std::pair<const ir::CycleStatement*, ir::ResultName>, std::uint32_t>
      kept; // results kept in locals
  // Results that a statement reads where ways with several measurements meet: each of those keeps it there.
  std::map<std::pair<std::size_t, ir::ResultName>, std::uint32_t> merged;
};

// What copied blocks change.
struct CopiedModes {
  bool workSystem = false;                     // one of G54 to G59 may be another one
  std::vector<const stdlib::CodeInfo*> groups; // a member of each further group that a bare code puts back
  bool staysTurned = false;                    // G68 stays in force: another plane under it is not allowed
  // Before each statement of the body, a code that a copied block may have left in force, beside what a bare
  // code puts back: "G68"; "" for none. Empty where nothing is copied.
  std::vector<std::string> inForce;
};

// A work system of a call, and the numbers beside 54 to 59 that name one there.
struct NamedSystem {
  ir::ExpressionPtr number;
  ExtendedSystems extended;
};

struct State {
  State(const ir::Cycle& given, const EmitOptions& emitOptions, const SourceMap& sourceMap,
        Diagnostics& report, std::vector<Argument> letters);

  template <class Id, class... Args> Diagnostic& refuse(SourceRange range, const Args&... args) {
    failed = true;
    return diagnostics.report<Id>(range, args...);
  }
  Mark mark() { return nextMark++; }
  // "#24"; reports where no local is left.
  std::string local(ir::VariableId id);
  // A local until releaseHelpers(); 0: none is left.
  std::uint32_t helper();
  void releaseHelpers();
  // The host input, which is added where the cycle does not know it.
  ir::VariableId host(std::string_view name);
  std::optional<ir::VariableId> findHost(std::string_view name) const;
  // Where the cycle began, along `axis`, in work coordinates: a constant where it was fixed.
  ir::ExpressionPtr start(ir::Axis axis);
  bool isArgument(ir::VariableId id) const;

  ir::Cycle cycle; // a copy: hosts are added
  const EmitOptions& options;
  const stdlib::Control& control;
  const stdlib::MacroSet& macros;
  const SourceMap& sources;
  Diagnostics& diagnostics;
  std::vector<Argument> arguments;
  Locals pool;
  std::map<ir::VariableId, std::uint32_t> locals;
  std::vector<std::uint32_t> helpers, freeHelpers; // in use by this statement; by others before
  Sheet sheet;                                     // the part that is being written
  Mark nextMark = 0;
  bool failed = false;
  bool inWord = false; // an address is before what is printed: ROUND means something else there

  // Alarms: those of the source by statement, then ours, in the order of their numbers.
  std::vector<AlarmText> alarms;
  std::map<const ir::CycleStatement*, std::size_t> sourceAlarms; // index in `alarms`
  Guards guards;
  CopiedModes copied;
  std::vector<NamedSystem> systems;         // work systems to be checked at entry
  std::vector<ir::ExpressionPtr> distances; // of touches along a direction, likewise
  std::vector<ir::ExpressionPtr> tools;     // tool offsets, likewise
  std::vector<ir::ExpressionPtr> lengths;   // tool offsets that blocks put in force, likewise
  std::vector<std::string> remarks;         // of the header
  std::set<std::string> reported;           // what is said once for the whole program
  std::set<ir::VariableId> moving;          // movingVariables() of the cycle
  // Arguments that checks ask for where they read them; before each statement of the checks those of them
  // that some way to it has not asked for; of the statement that is being written, those still to be asked
  // for.
  std::set<ir::VariableId> late;
  std::vector<std::set<ir::VariableId>> notAsked;
  std::set<ir::VariableId> toAsk;
  bool shiftOfZ = false;     // an offset of Z is written
  bool writesOffset = false; // some offset is, by the program itself
  // Copied blocks select work systems beyond G59 by the code of the control that is written.
  bool extendedTranslated = false;
  std::size_t waited = 0;     // size of `sheet` where the axes are waited for
  const Body* body = nullptr; // facts of the body while it is written, else null
  std::size_t at = 0;         // index of the statement of the body that is being written
  // Kept errors whose local holds, until the call has been dealt with, the place at which the feature is
  // expected.
  std::set<std::pair<const ir::CycleStatement*, ir::ResultName>> expectedRead;
};

// "G65", "G54.1", "M3".
std::string codeText(const stdlib::CodeInfo& code);

// ---- Expressions.cpp ----

// How the constants of a text are written.
enum class Form : std::uint8_t {
  Length,   // with a point, at most the control's decimals: lengths, angles, feeds
  Selector, // with a point, whole: `S56.`
  Whole,    // without a point: `S3`
  Source,   // as the source writes it
};

// A variable of the control, by its number.
ir::ExpressionPtr systemVariable(int number);
// Simplified, and terms of a sum that cancel are gone.
ir::ExpressionPtr tidy(const ir::ExpressionPtr& expression);
// `value` as a number of a word; reports lost digits and numbers that do not fit.
std::string numberWord(State& state, double value, Form form, SourceRange range);
// Address and value. Lines that compute parts of it go to the sheet first.
std::string word(State& state, char address, const ir::ExpressionPtr& value, Form form,
                 const ir::Origin& origin);
// `left` = value, with what has to be computed before.
void assign(State& state, const std::string& left, const ir::ExpressionPtr& value, const ir::Origin& origin);
// Right side of an assignment where one line says it; lines may go to the sheet first.
std::string valueText(State& state, const ir::ExpressionPtr& value, const ir::Origin& origin);
// One side of a comparison, with at most `depth` brackets inside one another.
std::string operandText(State& state, const ir::ExpressionPtr& value, const ir::Origin& origin,
                        std::uint32_t depth);
// Text of a machine variable: `#550`, `#[5221+[#7-54]*20]`.
std::string machineText(State& state, const ir::ExpressionPtr& number, const ir::Origin& origin);

// ---- Conditions.cpp ----

void jumpIf(State& state, const ir::ConditionPtr& condition, Mark target, const ir::Origin& origin);
// `statement` ("#3000=..", "#7=56.") where the condition holds.
void doIf(State& state, const ir::ConditionPtr& condition, const std::string& statement,
          const ir::Origin& origin);

// ---- Alarms.cpp ----

// Numbers for the alarms of checks and body, in source order.
void collectAlarms(State& state);
// `#3000=n(TEXT)` of an alarm statement of the source; its full text goes to the sheet as a comment.
std::string sourceAlarm(State& state, const ir::CycleStatement& statement);
// `#3006=n(TEXT)`, where the control has that; the full text goes to the sheet where it is cut.
std::string stopText(State& state, const ir::Stop& stop, const ir::Origin& origin);
// An alarm of our own where the condition holds.
void alarmIf(State& state, const ir::ConditionPtr& condition, std::string_view text,
             const ir::Origin& origin);
// Only characters that are in a comment; reports with a note what was changed.
std::string commentText(State& state, std::string_view utf8, SourceRange range);
// Upper case, only characters that every control shows.
std::string headerText(std::string_view utf8);

// ---- Flow.cpp ----

// Writes checks or body.
void writeList(State& state, const std::vector<ir::CycleStatement>& list, bool body);

// ---- Blocks.cpp ----

// Writes the block that begins at `at` of the body; gives the index after it.
std::size_t writeBlock(State& state, const std::vector<ir::CycleStatement>& list, std::size_t at);

// ---- CycleVariables.cpp ----

// Machine variables of the source become those of the control that mean the same; refused where none does.
void translateVariables(State& state);
// ---- ExtendedSystem.cpp ----

// In copied blocks the source's code for a work system beyond G59 becomes that of the control.
void translateExtendedSystem(State& state);

// ---- CycleVariables.cpp ----

// A copied block. For another control than the source's: where both know its codes by one meaning; else
// refused, "".
std::string copiedText(State& state, const ir::OpaqueBlock& block, const ir::Origin& origin);
// A program may write the variable: an offset or a timer.
bool isSettable(const stdlib::Control& control, std::uint32_t number);

// ---- Places.cpp ----

Body findBody(const State& state);
// `coordinate` along `axis`, counted from `wanted` (Work, or Here); nullptr: refused.
ir::ExpressionPtr place(State& state, const ir::Coordinate& coordinate, ir::Axis axis, ir::Frame wanted,
                        SourceRange range);
// A move of the contact point, which depends on direction and radius: refused.
bool isOfContact(State& state, const ir::Move& move, const ir::Origin& origin);
// Where the probe is, work coordinates; nullptr: not known (nothing is reported).
ir::ExpressionPtr workPosition(State& state, ir::Axis axis);
// The same as the control tells it where the program gets there: a block that waits goes to the sheet before
// (once for several axes), the tool's length is taken off. nullptr: the control has no variable for it.
ir::ExpressionPtr positionNow(State& state, ir::Axis axis, const ir::Origin& origin);

// ---- MacroCalls.cpp ----

void writeProtectedMove(State& state, const ir::Move& move, const ir::Origin& origin);
void writeMeasure(State& state, const ir::Measure& measure, const ir::Origin& origin);
void writeCycle(State& state, const ir::CallCycle& cycle, const ir::Origin& origin);
// ---- CalledPrograms.cpp ----

// The program that ir::kProgram calls; nullptr: it is another call.
const CalledProgram* calledProgram(const State& state, const ir::CallCycle& call);
void writeProgramCall(State& state, const CalledProgram& program, const ir::CallCycle& call,
                      const ir::Origin& origin);

// ---- MacroCalls.cpp ----

// By the macro set's own call, else by the control's code; reports where neither has one.
void writeProbePower(State& state, bool on, const ir::Origin& origin);

// ---- OffsetWrite.cpp ----

// Sets the offset of `setting` along `axis` by what the last call measured.
void writeOffset(State& state, const ir::OffsetSetting& setting, ir::Axis axis,
                 const stdlib::MacroSignature& signature, const ir::Origin& origin);
// Number of the variable that holds the offset of `system` along `axis`.
ir::ExpressionPtr offsetNumber(const stdlib::Control& control, const ir::ExpressionPtr& system,
                               ir::Axis axis);
// Variable that holds the active work system.
std::optional<int> workSystemVariable(const stdlib::Control& control);
// A block that the control does not read beyond before the axes are; nothing where it has none.
void writeWait(State& state, const ir::Origin& origin);
void writeSystemAlarm(State& state, const NamedSystem& system, const ir::Origin& origin);
// A default with which the program would end in the alarm of writeSystemAlarm is none.
void dropDefaultsElsewhere(State& state);
// Where `offset` is not above 0.
void writeLengthAlarm(State& state, const ir::ExpressionPtr& offset, const ir::Origin& origin);
// What it reads is given before the body begins, and the body changes none of it.
bool knownAtEntry(const State& state, const ir::ExpressionPtr& value);
// Numbers with which the macros of the source set G54.1 P1 and following, counted as those of the system are;
// as far as the macro takes such numbers where it is `called` with them, and else the program writes the
// offset.
ExtendedSystems extendedSystems(const State& state, const stdlib::MacroSignature& signature, bool called);
// Text of the variable that holds the offset that is set along `axis`.
std::string offsetText(State& state, const ir::OffsetSetting& setting, ir::Axis axis,
                       const stdlib::MacroSignature& signature, const ir::Origin& origin);
// The number of the system as the macro of the target reads it, where that of the source reads others beyond
// G59 (S101, S154.01). What is computed goes into a local before the call.
ir::ExpressionPtr systemForCall(State& state, const ir::ExpressionPtr& system,
                                const stdlib::MacroSignature& signature, const ir::Origin& origin);
// Makes sure that there is such a tool offset. false: refused.
bool guardTool(State& state, const ir::ExpressionPtr& tool, const ir::Origin& origin);
// Whether the checks of the one argument that `value` counts from let whole values of `least` to `most` pass
// and, of others that are tried, none.
bool confinedTo(const State& state, const ir::ExpressionPtr& value, double least, double most);
// Makes sure that `system` is 54 to 59, or one of `extended`, where nothing else does.
void guardSystem(State& state, const ir::ExpressionPtr& system, const ir::Origin& origin,
                 const ExtendedSystems& extended = {});

// ---- Results.cpp ----

// A macro of the set may run where the statement does.
bool callsMacro(const State& state, const ir::CycleStatement& statement);

// Reserves locals for results that a later call of a macro would overwrite before they are used.
void planResults(State& state, Body& body);
// The call expects along the axis what the position says at which it is made, and that is known on the
// control alone.
bool isAtPosition(State& state, const ir::CallCycle& cycle, ir::Axis axis);
// Before the call of the measurement that is being written: reads the place from which an error counts, where
// it is known on the control alone.
void keepPositions(State& state, const ir::Origin& origin);
// After the measurement that is being written: keeps what was reserved.
void keepResults(State& state, const ir::Origin& origin);
// "#135": what holds the result; "" where it was refused.
std::string resultText(State& state, ir::ResultName name, SourceRange range);

// ---- Prologue.cpp ----

// Which states of the machine the program can ask for.
Guards findGuards(const stdlib::Control& control);
// Omitted arguments: their default, or an alarm.
void writeArguments(State& state);
// Where the cycle begins, read into locals.
void writeStarts(State& state);
void writeRequirements(State& state);
// The argument may be omitted: it has a default that moves nothing, or may be null.
bool mayBeOmitted(const State& state, ir::VariableId id);

// ---- Demands.cpp ----

// Which mandatory arguments are needed on some ways through the checks only, and by nothing else.
void planDemands(State& state);
// The alarm of each of `ids` that is still to be asked for.
void demand(State& state, const std::set<ir::VariableId>& ids, const ir::Origin& origin);
// The condition reads an argument that is still to be asked for.
bool demandsWithin(const State& state, const ir::ConditionPtr& condition);

// ---- Copied.cpp ----

// Refuses what stays in force at the end and cannot be put back.
CopiedModes findCopiedModes(State& state);

// ---- Modes.cpp ----

// Locals for the modal groups that the program changes, and what is around the body.
struct SavedMode {
  const stdlib::CodeInfo* code = nullptr; // a member of the group; nullptr: the feed
  std::uint32_t local = 0;
};
std::vector<SavedMode> planModes(State& state);
void writeModes(State& state, const std::vector<SavedMode>& saved);
void restoreModes(State& state, const std::vector<SavedMode>& saved);

// ---- Ranges.cpp ----

// Values of the argument that the checks let pass: "54 TO 59", "SEE ALARMS", "" for all.
std::string rangeText(const State& state, ir::VariableId id);

// ---- Header.cpp ----

// Everything before the first block, `%` included.
Sheet header(State& state);

} // namespace dotek::backends::fanuc
