// Findings in macros, dialogs and DefineData.txt, each kind a check of its own.
#pragma once

#include "frontend/gibbs/Cycle.h"
#include "frontend/gibbs/Match.h"
#include "frontend/gibbs/Parse.h"
#include "support/Check.h"

#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace dotek::frontend::gibbs {

// Where the labels, FORs and NEXTs of a macro do not meet.
struct FlowFindings {
  struct OtherFor {
    const Name* next;
    Name open; // the variable of the innermost FOR that is open
    SourceRange openRange;
  };
  std::vector<std::pair<SourceRange, Name>> forsWithoutNext;
  std::vector<SourceRange> nextsWithoutFor;
  std::vector<OtherFor> nextsOfOther;
  std::vector<SourceRange> continuesOutside;
  std::vector<std::pair<Name, SourceRange>> labelsTwice; // with the first one
  std::vector<Name> undefinedLabels;
  std::vector<std::string> labels;  // that a jump may name, as spelt, those of included files folded
  std::vector<SourceRange> intoFor; // unverified
  std::optional<SourceRange> tooDeep;
};

// One parsed file, and what several checks ask of it. What is passed outlives it.
class CheckedFile {
public:
  // `included` are the macros that #INCLUDE brings in: their labels count as the file's own. FORs that are
  // nested too deep are reported, and a file that ends in the middle of a command: neither is judged then.
  CheckedFile(const Macro& parsed, std::vector<const Macro*> included, const ParseContext& context);
  CheckedFile(const Dialog& parsed, const ParseContext& context);
  CheckedFile(const DefineData& parsed, const ParseContext& context);

  // One of the three.
  const Macro* macro = nullptr;
  const Dialog* dialog = nullptr;
  const DefineData* defines = nullptr;

  FileId file = kNoFile;
  const SourceMap& sources;
  const stdlib::GibbsKeywords& keywords;
  const Limits& limits;

  std::vector<const Statement*> statements;   // of a macro, those inside an IF after it
  std::vector<const Expression*> expressions; // all, inner ones after the one that holds them
  std::set<std::string> variables, arrays;    // folded names that the macros use, or use with an index
  FlowFindings flow;                          // of a macro

  // A command or a control that the tables know, with its arguments.
  struct Call {
    const Name* name;
    const std::vector<ExpressionPtr>* arguments;
    SourceRange range;
    std::vector<const stdlib::CommandSignature*> signatures;
    Match match;
    bool cutOff = false; // the file ends after it, and no form has so few arguments
    // The table is sure of the command, and the line is whole.
    bool judged() const { return match.signature != nullptr && !match.signature->unsure && !cutOff; }
  };
  std::vector<Call> calls;

  std::string text(SourceRange range) const { return sources.textUtf8(range); }
  // An element of an array is written as a function is.
  bool isUnknownFunction(const Expression& expression) const;
  // The expression itself holds something that a check reports.
  bool isWrong(const Expression& expression) const;

private:
  void collectNames(const Macro& from);
  void reportCutOff(Diagnostics& diagnostics) const;
  void add(const Statement& statement);
  void add(const Expression& expression);
  void add(const Control& control);
  void call(const Name& name, const std::vector<ExpressionPtr>& arguments,
            std::vector<const stdlib::CommandSignature*> signatures, SourceRange range);
};

// `; did you mean `NAME`?`, or nothing.
std::string didYouMean(const std::string& name);

// Whether an element may appear in the block.
bool belongs(const Command& element, const GeometryBlock& block);

// The caption of a FRAME that is without quotes; nullptr for none.
const Expression* looseCaptionOf(const Control& control);

// Labels, FOR and NEXT.
DOTEK_CHECK(CheckedFile, undefinedLabel, "undefined-label", Error);
DOTEK_CHECK(CheckedFile, duplicateLabel, "duplicate-label", Error);
DOTEK_CHECK(CheckedFile, forWithoutNext, "for-without-next", Error);
DOTEK_CHECK(CheckedFile, nextWithoutFor, "next-without-for", Error);
DOTEK_CHECK(CheckedFile, nextOfOtherFor, "next-of-other-for", Error);
DOTEK_CHECK(CheckedFile, continueOutsideFor, "continue-outside-for", Error);
// Commands, functions and their arguments.
DOTEK_CHECK(CheckedFile, unknownCommand, "unknown-command", Warning);
DOTEK_CHECK(CheckedFile, renamedCommand, "renamed-command", Warning);
DOTEK_CHECK(CheckedFile, misplacedWord, "misplaced-word", Warning);
DOTEK_CHECK(CheckedFile, argumentCount, "argument-count", Warning);
DOTEK_CHECK(CheckedFile, argumentKind, "argument-kind", Warning);
DOTEK_CHECK(CheckedFile, unknownParameter, "unknown-parameter", Warning);
DOTEK_CHECK(CheckedFile, unverifiedName, "unverified-name", Note);
DOTEK_CHECK(CheckedFile, unknownFunction, "unknown-function", Warning);
DOTEK_CHECK(CheckedFile, fileUnit, "file-unit", Warning);
DOTEK_CHECK(CheckedFile, tooManyNames, "too-many-names", Error);
// Expressions and statements.
DOTEK_CHECK(CheckedFile, textAndNumber, "text-and-number", Warning);
DOTEK_CHECK(CheckedFile, textTooLong, "text-too-long", Warning);
DOTEK_CHECK(CheckedFile, commaBeforeThen, "comma-before-then", Note);
DOTEK_CHECK(CheckedFile, unverifiedConstruct, "unverified-construct", Note);
// Dialogs and DefineData.txt.
DOTEK_CHECK(CheckedFile, dialogWithoutOk, "dialog-without-ok", Error);
DOTEK_CHECK(CheckedFile, dialogWithoutCancel, "dialog-without-cancel", Error);
DOTEK_CHECK(CheckedFile, dialogNotFirst, "dialog-not-first", Error);
DOTEK_CHECK(CheckedFile, controlTwice, "control-twice", Error);
DOTEK_CHECK(CheckedFile, unknownControl, "unknown-control", Warning);
DOTEK_CHECK(CheckedFile, variableTwice, "variable-twice", Warning);
DOTEK_CHECK(CheckedFile, imageName, "image-name", Warning);
DOTEK_CHECK(CheckedFile, looseCaption, "loose-caption", Note);
DOTEK_CHECK(CheckedFile, duplicateDefinition, "duplicate-definition", Error);
DOTEK_CHECK(CheckedFile, fieldValue, "field-value", Note);

// All checks of one file.
std::span<const Check<CheckedFile>* const> fileChecks();

// The value of a plain number, with at most one sign before it; nothing for any other expression.
std::optional<double> plainValue(const Expression& expression);

// The files of a cycle together: the names that they set and read. What is passed outlives it.
class CheckedCycle {
public:
  CheckedCycle(const Cycle& folder, const SourceMap& files, const stdlib::GibbsKeywords& known);

  const Cycle& cycle;
  const SourceMap& sources;
  const stdlib::GibbsKeywords& keywords;

  std::set<std::string> set;                // folded
  std::vector<const Name*> read;            // in the order of the text
  std::map<std::string, std::string> spelt; // folded name to a spelling, for proposals
  std::set<std::string> fields;             // of DefineData.txt, folded
  std::set<std::string> bound;              // to inputs of dialogs, folded
  bool whole = true;                        // all files were found and read

private:
  void define(const Name& name);
  void collect(const Macro& macro);
  void collect(const Statement& statement);
  void collect(const Command& command);
  void collect(const Dialog& dialog);
  void readAll(const Expression& expression);
};

DOTEK_CHECK(CheckedCycle, undefinedVariable, "undefined-variable", Warning);
DOTEK_CHECK(CheckedCycle, inputNotDeclared, "input-not-declared", Warning);
DOTEK_CHECK(CheckedCycle, fieldWithoutInput, "field-without-input", Note);
DOTEK_CHECK(CheckedCycle, inputOpensWithOther, "input-opens-with-other", Warning);
DOTEK_CHECK(CheckedCycle, dialogFileMissing, "dialog-file-missing", Error);

std::span<const Check<CheckedCycle>* const> cycleChecks();

} // namespace dotek::frontend::gibbs
