// What the parts of the back end share while they write one fragment.
#pragma once

#include "backends/common/MacroCall.h"
#include "backends/fusion/Script.h"

#include <set>
#include <string_view>

namespace dotek::backends::fusion {

// Private functions of a fragment that are in it only where they are called.
// mm: half of the last digit that a block prints.
inline constexpr std::string_view kHalfDigit = "0.0005";

enum class Helper : std::uint8_t {
  Given, // the decimal that was typed, of an input in 32 bits
  IsNumber,
  Digits,  // of Picture
  Picture, // text of a value in a picture
  Shown,   // value that a picture prints
  Number,  // text of a value in the fixed format
  Fine,    // the same with six decimals
  Loses,   // a warning where the text says another value
  Comment, // a comment as the post writes it
  Truncate,
  RoundUp,
  Round,
  Divide,
  Modulo,
  SquareRoot,
  Sine,
  Cosine,
  Tangent,
  ArcSine,
  ArcCosine,
  ArcTangent,
  Direction,
  Logarithm,
  Bits,
};

struct State {
  State(const ir::Cycle& given, const EmitOptions& emitOptions, Diagnostics& report);

  template <class Id, class... Args> Diagnostic& refuse(SourceRange range, const Args&... args) {
    failed = true;
    return diagnostics.report<Id>(range, args...);
  }
  // PREFIX_name of a helper, which the fragment then holds.
  std::string helper(Helper which);
  // The host input, which is added where the cycle does not know it.
  ir::VariableId host(std::string_view name);
  // The name of a variable in the function; parameters and hosts that are asked for are read at its
  // beginning.
  const std::string& name(ir::VariableId id);
  // `error(localize(..)); return;` where `condition` holds.
  void errorIf(const std::string& condition, std::string_view text, const ir::Origin& origin);

  ir::Cycle cycle; // a copy: hosts are added
  const EmitOptions& options;
  Diagnostics& diagnostics;
  std::string prefix;
  LocalNames names;
  std::map<ir::VariableId, std::string> named;
  std::set<ir::VariableId> read; // parameters and hosts that the function reads
  std::set<Helper> helpers;
  Script script; // the part that is being written
  bool failed = false;
};

// ---- Expressions.cpp ----

// The value in JavaScript; an operand of another operator gets brackets. What a control alone knows is
// refused.
std::string valueText(State& state, const ir::ExpressionPtr& value, SourceRange range, bool operand = false);
std::string conditionText(State& state, const ir::ConditionPtr& condition, SourceRange range);
// Before a statement that computes: an error where arithmetic has no result.
void guardArithmetic(State& state, const ir::ExpressionPtr& value, const ir::Origin& origin);
void guardArithmetic(State& state, const ir::ConditionPtr& condition, const ir::Origin& origin);

// ---- Checks.cpp ----

// The checks of the cycle: if where they are structured, else a switch in a loop.
void writeChecks(State& state);

// ---- Blocks.cpp ----

// The texts of all values first, so that nothing is written before the last error; then the blocks.
void writeBlocks(State& state);

// ---- Call.cpp ----

// Texts of the arguments, checks, then the way to the start and the call.
void writeCall(State& state);
// The functions that write the program.
void writeProgram(State& state);
// The field has no value unless the operation says that it gives it.
bool mayBeLeftOut(const State& state, ir::VariableId id);

// Pieces of a block on their way to one string expression.
class Text {
public:
  void add(std::string_view literal) { pending_ += literal; }
  void addExpression(std::string expression);
  std::string expression() const;
  // Why the line is there, of one that no block of the source makes; "" of the others.
  void because(std::string reason) { reason_ = std::move(reason); }
  const std::string& reason() const { return reason_; }

private:
  std::vector<std::string> parts_;
  std::string pending_, reason_;
};

// A value that blocks print: its text is computed once, checked, and kept in a variable.
class Texts {
public:
  explicit Texts(State& state) : state_(state) {}
  // The variable that holds the text of a variable in a picture; of a fixed one the text, quoted by `add`.
  void picture(Text& text, const ir::PrintedPiece& piece, SourceRange block);
  // The text of a value in the fixed format: three decimals, always a point.
  // `fine`: in a formula of the control, with six decimals where no number of digits holds the value.
  void number(Text& text, const ir::ExpressionPtr& value, const ir::Origin& origin, bool fine = false);

private:
  State& state_;
  std::map<std::string, std::string> known_; // what is printed -> variable
};

// ---- MacroBlocks.cpp ----

// Blocks of another macro set than the source's.
class MacroBlocks {
public:
  MacroBlocks(State& state, Texts& texts);
  // The lines that stand for the statements of one block; false: the Prog's own text does, each piece as
  // piece() writes it.
  bool block(const std::vector<const ir::CycleStatement*>& statements, std::vector<Text>& lines);
  // Text of the last block, where results that it compares are those of these macros. `beforePicture`: a
  // number at the end of the text may go on.
  void piece(Text& text, std::string_view printed, bool beforePicture, const ir::Origin& origin);
  // After the pieces of the block: refuses one whose results were not found in its text.
  void endBlock(const ir::Origin& origin);
  // After the last block: G91 where the source leaves it in force and our moves have written G90; nullptr:
  // no line, else the origin of the line.
  const ir::Origin* putBack(Text& text);

private:
  struct Place {
    ir::ExpressionPtr value; // work coordinate; null pointer: not known
  };
  // Labels, jumps and stores of the block: what is known of the position no more.
  void flow(const ir::CycleStatement& statement);
  // The place is not known any more where it reads what the store sets.
  static void forgetStored(Place& place, const ir::Store& store);
  // An expression of macro B; what the script knows is printed as its value.
  void macro(Text& text, const ir::ExpressionPtr& value, const ir::Origin& origin);
  void macroOperand(Text& text, const ir::ExpressionPtr& value, const ir::Origin& origin);
  // "IF[..GT..]THEN #3000=101(TEXT)"
  void alarmAbove(const ir::ExpressionPtr& value, const ir::ExpressionPtr& limit, std::string_view what,
                  std::vector<Text>& lines, const ir::Origin& origin);
  // Where the axis is as the control tells it; the lines then begin with a block that waits. nullptr: no
  // variable tells.
  ir::ExpressionPtr positionNow(ir::Axis axis);
  void wait(std::vector<Text>& lines);
  // Whether the script can tell that the macro's own correction is the source's setting.
  bool tellsNominal(const ir::Measure& measure);
  bool missesNominal(const ir::Measure& measure, const ir::Origin& origin);
  // Why the blocks cannot write an offset themselves; "": they can.
  std::string offsetObstacle(const stdlib::MacroSignature& signature, const ir::OffsetSetting& setting) const;
  ir::ExpressionPtr offsetOf(const ir::ExpressionPtr& system, ir::Axis axis) const;
  // The same of a system that the blocks set, which may be beyond G59.
  ir::ExpressionPtr settingOf(const ir::ExpressionPtr& system, ir::Axis axis) const;
  // The system as the call counts it, where the source counts those beyond G59 otherwise.
  ir::ExpressionPtr systemForCall(const ir::ExpressionPtr& system,
                                  const stdlib::MacroSignature& signature) const;
  // What follows the letter of a word; what the control reads is a formula there.
  void valueOfWord(Text& text, const ir::ExpressionPtr& value, const ir::Origin& origin);
  // Active offset + measured - nominal, after a check that nothing else shifts the axis.
  void checkShift(const ir::OffsetSetting& setting, std::vector<Text>& lines, const ir::Origin& origin);
  void writeOffset(const ir::OffsetSetting& setting, const stdlib::MacroSignature& signature,
                   std::vector<Text>& lines, const ir::Origin& origin);
  void move(const ir::Move& move, const ir::Origin& origin, std::vector<Text>& lines);
  void measure(const ir::Measure& measure, const ir::Origin& origin, std::vector<Text>& lines);
  void cycle(const ir::CallCycle& given, const ir::Origin& origin, std::vector<Text>& lines);
  CallValues values(const ir::Origin& origin);
  // The system of a measurement is 54 to 59, or one beyond that the call takes or the blocks set.
  void guardSystem(const ir::ExpressionPtr& system, const stdlib::MacroSignature& signature, bool called,
                   const ir::Origin& origin);
  void call(const MacroCall& call, const ir::Origin& origin, std::vector<Text>& lines);
  void code(stdlib::Function function, std::string_view what, const ir::Origin& origin, Text& text);
  // "#138-[12.5]": an error that the macros do not leave, from what they do; false: not known.
  bool errorText(ir::ResultName name, const stdlib::MacroSignature& signature, const ir::Origin& origin,
                 Text& text);
  void setLast(const ir::CycleStatement* measured);
  // At a label: what holds on all ways to it.
  void join(std::size_t label);
  // Before each statement of the body; see last_.
  const std::vector<std::set<const ir::CycleStatement*>>& lasts();
  FoundResult after(const ir::CycleStatement* measured, ir::ResultName name) const;
  // The results that a branch compares are in the same variables after the calls of both sets: its block
  // stays.
  bool comparesAlike(const ir::CycleStatement& statement);
  // They are in others: noted for piece(). false: which ones the source compares is not known.
  bool comparesOthers(const ir::CycleStatement& statement);
  // A result that the macros leave in another variable on each of the ways to the block that keeps it: where
  // each way leads straight from its call to that block, the copies stand after the calls.
  void planCopies();
  // Of a result that only comes near to what the source keeps.
  void reportInstead(const FoundResult& known, SourceRange range);
  bool leadsStraight(const std::vector<std::vector<std::size_t>>& next, std::size_t from,
                     std::size_t to) const;
  void copyResults(const ir::CycleStatement& measured, std::vector<Text>& lines);
  bool overwritesResults(const ir::CycleStatement& statement) const;
  // Where the result is after the last measurement; where several may be the last, in the variable that all
  // of them leave it in.
  FoundResult found(ir::ResultName name) const;
  void refuseResult(ir::ResultName name, SourceRange range);
  void store(const ir::Store& store, const ir::Origin& origin, std::vector<Text>& lines);
  void switchProbe(const ir::ProbePower& power, const ir::Origin& origin, std::vector<Text>& lines);
  bool leavesModes(const ir::OpaqueBlock& block);
  bool movesNothing(const ir::OpaqueBlock& block) const;
  bool endsBranch(const ir::CycleStatement& statement, const ir::OpaqueBlock& block) const;
  const stdlib::CodeInfo* codeOf(const ir::Word& word) const; // nullptr: none, or it is computed
  bool otherCode(const ir::CycleStatement& statement, Text& text);
  bool modeCode(const ir::SetMode& mode, const ir::Origin& origin, Text& text);
  bool requireNominal(const ir::Measure& measure, const ir::Origin& origin);
  // The coordinate in the frame that the macro wants; null pointer: refused. `reads`: where nothing else
  // tells where the probe is, the control's own variable does.
  ir::ExpressionPtr place(const ir::Coordinate& coordinate, ir::Axis axis, ir::Frame wanted,
                          const ir::Origin& origin, bool reads = false);
  void moved(const ir::Move& move);

  State& state_;
  Texts& texts_;
  Place at_[3];
  Place expected_[3];       // where the last measurement expects the feature
  bool wholeRound_ = false; // ROUND rounds to whole numbers, in an assignment; in a word to its increment
  // Measure or CallCycle whose results the macros hold; nullptr: none, or it depends on the way.
  const ir::CycleStatement* last_ = nullptr;
  std::set<const ir::CycleStatement*> joined_; // where it depends on the way: each; nullptr: on some way none
  std::vector<std::set<const ir::CycleStatement*>> lasts_; // before each statement
  // "#581=#135", after the measurement; and the stores of the source that these replace.
  std::map<const ir::CycleStatement*, std::vector<std::string>> copies_;
  std::set<const ir::CycleStatement*> moved_;
  std::map<std::uint32_t, ir::ResultName> compared_; // by the source's variable, in the block at hand
  std::set<std::uint32_t> replaced_;                 // of these, in its text
  const ir::Origin* incremental_ = nullptr;          // of the G91 that is in force in the source
  const ir::Origin* opaque_ = nullptr;               // of the copied block that is looked at
  bool overwritten_ = false;                         // by a G90 of ours
  bool calls_ = false;                               // as callsMacros() says
  bool waits_ = false;                               // the next line reads where the axes are
  bool saysSearch_ = false;                          // that it goes on beyond the source's
  std::map<std::string, int> alarms_;                // numbers of alarms of ours, by their texts
};

// A variable of the control or a result of its macros is in it: the script cannot compute it.
bool needsControl(const ir::ExpressionPtr& value);

// ---- Properties.cpp ----

void writeHead(State& state);
void writeProperties(State& state);
// Where the function begins: fields, host inputs.
void writeReading(State& state);

// ---- Helpers.cpp ----

void writeHelpers(State& state);

} // namespace dotek::backends::fusion
