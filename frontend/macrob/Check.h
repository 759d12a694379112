// Findings inside one program that need no other file, each kind a check of its own.
#pragma once

#include "frontend/macrob/Ast.h"
#include "frontend/macrob/Calls.h"
#include "frontend/macrob/Modes.h"
#include "stdlib/Control.h"
#include "support/Check.h"
#include "support/Source.h"

#include <algorithm>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace dotek::frontend::macrob {

// Where loops, jumps and blocks of a program do not meet. Points into the program.
struct FlowFindings {
  // A DO that has none, with the number of its END where that is known.
  std::vector<std::pair<const Do*, std::optional<std::uint32_t>>> dosWithoutNumber;
  std::vector<const End*> endsWithoutNumber;
  std::vector<const LoopNumber*> badNumbers;
  std::vector<std::pair<const Do*, const Do*>> numbersInUse; // inner, outer
  std::vector<std::pair<const End*, const Do*>> crossings;   // with the loop that is still open
  std::vector<const End*> endsWithoutDo;
  std::vector<const Do*> dosWithoutEnd;

  std::map<std::uint64_t, std::vector<SourceRange>> missingTargets; // the jumps, by the number that they name
  std::vector<SourceRange> badTargets;                              // of jumps to what numbers no block
  struct Numbered {
    std::uint64_t number = 0;
    SourceRange range, other;
  };
  std::vector<Numbered> targetsTwice;  // with the first one
  std::vector<Numbered> jumpsIntoLoop; // with the loop
  struct Dead {
    SourceRange range, jump;
    std::string extent; // "up to N20"
    std::string end;    // "M30" where the program ends before it; "": a jump passes over it
  };
  std::vector<Dead> dead;
};

// A parsed program, and what several checks ask of it. What is passed outlives it.
class CheckedProgram {
public:
  // `control`: the machine that the program is for; nullptr: only what holds on every control, and what each
  // of `profiles` says, those that the program may be for.
  CheckedProgram(const Program& parsed, const stdlib::Control* machine, const SourceMap& files,
                 std::span<const stdlib::Control> profiles = {});

  const Program& program;
  const stdlib::Control* control;
  // The control alone, or all profiles; none: nothing is known of the machine.
  std::span<const stdlib::Control> machines;
  // It holds of each of them, and there is one.
  template <class Predicate> bool onEach(const Predicate& holds) const {
    return !machines.empty() && std::all_of(machines.begin(), machines.end(), holds);
  }
  // "Fanuc 0i-MD", or "each control of which Dotek has a profile (fanuc-0i-md, ..)".
  std::string machineText() const;
  const SourceMap& sources;

  // An expression of a block, inner ones after the one that holds them; numbers of few digits are left out.
  // `subscript`: it is part of the number of a variable, #[..].
  struct Part {
    const Expression* expression;
    bool subscript;
  };
  std::vector<Part> parts;
  std::vector<const Condition*> conditions; // of IF and WHILE
  // Blocks of words that call a macro with arguments (G65, G66, G66.1), and all others.
  std::vector<Call> calls;
  std::vector<const Words*> plain;
  std::vector<Call> subprograms; // M98; in `plain` as well
  FlowFindings flow;
  // Before each block; see modesBefore.
  const std::vector<std::optional<Modes>>& modes() const;

private:
  mutable std::optional<std::vector<std::optional<Modes>>> modes_; // when they are asked for
};

// Loops, jumps, blocks that never run.
DOTEK_CHECK(CheckedProgram, doWithoutNumber, "do-without-number", Error);
DOTEK_CHECK(CheckedProgram, endWithoutNumber, "end-without-number", Error);
DOTEK_CHECK(CheckedProgram, loopNumberRange, "loop-number-range", Error);
DOTEK_CHECK(CheckedProgram, loopNumberInUse, "loop-number-in-use", Error);
DOTEK_CHECK(CheckedProgram, loopsCross, "loops-cross", Error);
DOTEK_CHECK(CheckedProgram, endWithoutDo, "end-without-do", Error);
DOTEK_CHECK(CheckedProgram, doWithoutEnd, "do-without-end", Error);
DOTEK_CHECK(CheckedProgram, gotoTargetMissing, "goto-target-missing", Error);
DOTEK_CHECK(CheckedProgram, duplicateTarget, "duplicate-target", Warning);
DOTEK_CHECK(CheckedProgram, jumpIntoLoop, "jump-into-loop", Error);
DOTEK_CHECK(CheckedProgram, blockNeverRuns, "block-never-runs", Warning);
// Numbers of variables, what is written, `#` at the wrong place.
DOTEK_CHECK(CheckedProgram, variableOutOfRange, "variable-out-of-range", Error);
DOTEK_CHECK(CheckedProgram, nullWritten, "null-written", Error);
DOTEK_CHECK(CheckedProgram, readOnlyWritten, "read-only-written", Error);
DOTEK_CHECK(CheckedProgram, subscriptAsValue, "subscript-as-value", Warning);
DOTEK_CHECK(CheckedProgram, tableBaseRead, "table-base-read", Warning);
DOTEK_CHECK(CheckedProgram, hashMissing, "hash-missing", Warning);
DOTEK_CHECK(CheckedProgram, offsetOverwritten, "offset-overwritten", Warning);
// What the control can calculate and compare.
DOTEK_CHECK(CheckedProgram, bracketsTooDeep, "brackets-too-deep", Error);
DOTEK_CHECK(CheckedProgram, numberDigits, "number-digits", Warning);
DOTEK_CHECK(CheckedProgram, functionUnknownHere, "function-unknown-here", Error);
DOTEK_CHECK(CheckedProgram, functionWithoutBrackets, "function-without-brackets", Warning);
DOTEK_CHECK(CheckedProgram, fixOfComputed, "fix-of-computed", Note);
DOTEK_CHECK(CheckedProgram, joinedUnknownHere, "joined-unknown-here", Error);
DOTEK_CHECK(CheckedProgram, constantCondition, "constant-condition", Warning);
DOTEK_CHECK(CheckedProgram, equalityOfComputed, "equality-of-computed", Warning);
DOTEK_CHECK(CheckedProgram, thenUnknownHere, "then-unknown-here", Error);
DOTEK_CHECK(CheckedProgram, thenGoto, "then-goto", Warning);
// What is lost in typing.
DOTEK_CHECK(CheckedProgram, pointLost, "point-lost", Warning);
DOTEK_CHECK(CheckedProgram, absMissing, "abs-missing", Warning);
// Words and calls.
DOTEK_CHECK(CheckedProgram, codeWithPoint, "code-with-point", Error);
DOTEK_CHECK(CheckedProgram, wordWithoutPoint, "word-without-point", Warning);
DOTEK_CHECK(CheckedProgram, argumentWithoutPoint, "argument-without-point", Error);
DOTEK_CHECK(CheckedProgram, argumentBeforeCall, "argument-before-call", Warning);
DOTEK_CHECK(CheckedProgram, noArgument, "no-argument", Error);
DOTEK_CHECK(CheckedProgram, argumentOrder, "argument-order", Warning);
DOTEK_CHECK(CheckedProgram, argumentOverwritten, "argument-overwritten", Warning);
DOTEK_CHECK(CheckedProgram, positionReadEarly, "position-read-early", Warning);
DOTEK_CHECK(CheckedProgram, callWordsAlone, "call-words-alone", Warning);
DOTEK_CHECK(CheckedProgram, callWithoutProgram, "call-without-program", Error);
// What a control or a command takes in no block.
DOTEK_CHECK(CheckedProgram, printedFormat, "printed-format", Error);
DOTEK_CHECK(CheckedProgram, blockDeleteOfLoop, "block-delete-of-loop", Error);
DOTEK_CHECK(CheckedProgram, returnRepeated, "return-repeated", Error);
DOTEK_CHECK(CheckedProgram, atanDivisor, "atan-divisor", Warning);
DOTEK_CHECK(CheckedProgram, wordOutOfRange, "word-out-of-range", Error);
DOTEK_CHECK(CheckedProgram, wordRepeated, "word-repeated", Warning);
DOTEK_CHECK(CheckedProgram, wordNotTaken, "word-not-taken", Warning);
DOTEK_CHECK(CheckedProgram, codesExclude, "codes-exclude", Warning);
DOTEK_CHECK(CheckedProgram, arcWithoutCentre, "arc-without-centre", Warning);
DOTEK_CHECK(CheckedProgram, modeAfterAxis, "mode-after-axis", Warning);
DOTEK_CHECK(CheckedProgram, wearInGeometry, "wear-in-geometry", Warning);
DOTEK_CHECK(CheckedProgram, systemVariableUnknown, "system-variable-unknown", Warning);
// What the modes before a block make of it.
DOTEK_CHECK(CheckedProgram, feedMissing, "feed-missing", Warning);
DOTEK_CHECK(CheckedProgram, cycleWords, "cycle-words", Warning);
DOTEK_CHECK(CheckedProgram, modeForbidsCode, "mode-forbids-code", Warning);
DOTEK_CHECK(CheckedProgram, arcGeometry, "arc-geometry", Warning);
DOTEK_CHECK(CheckedProgram, rotationWords, "rotation-words", Warning);
DOTEK_CHECK(CheckedProgram, callsItself, "calls-itself", Warning);
// What is set, and what cannot be computed.
DOTEK_CHECK(CheckedProgram, dataInputWords, "data-input-words", Warning);
DOTEK_CHECK(CheckedProgram, dwellWords, "dwell-words", Warning);
DOTEK_CHECK(CheckedProgram, signalValue, "signal-value", Warning);
DOTEK_CHECK(CheckedProgram, calculationStops, "calculation-stops", Warning);
// Alarms and messages.
DOTEK_CHECK(CheckedProgram, alarmNumberRange, "alarm-number-range", Warning);
DOTEK_CHECK(CheckedProgram, alarmWithoutText, "alarm-without-text", Note);
DOTEK_CHECK(CheckedProgram, messageTooLong, "message-too-long", Warning);

// All of them.
std::span<const Check<CheckedProgram>* const> programChecks();

// Runs them on each program of a file. What the parser reported is not repeated.
void checkFile(const File& file, const stdlib::Control* control, const SourceMap& sources,
               Diagnostics& diagnostics);

// One finding of no-argument: `word` in a block with the call `name`.
void reportNoArgument(SourceRange range, std::string_view word, std::string_view name, Report& report);

} // namespace dotek::frontend::macrob
