// One cycle as its checks walk it: what is known at each place of the control flow.
#pragma once

#include "frontend/cycle/Check.h"
#include "frontend/cycle/Kinds.h"

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace dotek::frontend::cycle {

enum class ProbeState : std::uint8_t { Off, On, Either };

// What holds on every path to a place.
struct Known {
  std::set<std::string, std::less<>> set; // results, variables, touches and calls that have their values
  // Optional parameters that the caller has given, and touches that have found something.
  std::set<std::string, std::less<>> given;
  ProbeState probe = ProbeState::Off;
  bool ended = false; // no path gets here

  bool has(const std::string& touch) const { return set.contains(touch) || given.contains(touch); }
};
Known joined(const Known& a, const Known& b);

// A written number in mm, degrees, mm/min or seconds; nullopt: the value is computed, or missing.
std::optional<double> constant(const ExpressionPtr& expression);

// Reports moves that nothing watches, an end below the start, and a spindle that nobody has stopped.
void checkMotion(const File& file, Diagnostics& diagnostics);

class Checker {
public:
  Checker(const File& file, const SourceMap& sources, Diagnostics& diagnostics);
  void run();

private:
  // ---- CheckDeclarations.cpp
  void header();
  void declare(const Statement& statement);
  void use(const Use& use);
  void result(const Result& result);
  void parameter(const Parameter& parameter);
  bool declareName(const Name& name, Symbol symbol);
  void declareNames(const Parameter& parameter);
  void clauses(const Parameter& parameter);
  void unread();

  // ---- CheckDefaults.cpp
  void defaults();
  // Names of touches, called cycles and values, wherever they get their values.
  void collect(const Block& block);
  static std::vector<std::string> wordsOf(std::string_view line);
  void collectDeclarations();

  // ---- CheckSlips.cpp
  void slips(const Block& block); // of the block alone
  void neverRead(const std::vector<Statement>& all, std::size_t at);
  void neverRuns(const For& loop, const Statement& statement);
  void neverEnds(const While& loop);
  void oneAnswer(const Expression& expression);

  // ---- CheckMeans.cpp
  void means(const Block& block); // sums in its loops
  void meanOf(const Expression& expression);
  void bothLimits(const Expression& expression);

  // ---- CheckFlow.cpp
  void block(const Block& block, Known& known);
  void statement(const Statement& statement, Known& known);
  // Reports a written number that is none of those that are taken there.
  void wantConstant(const ExpressionPtr& expression, bool (*takes)(double), std::string_view what,
                    std::string_view wanted);
  void wantCount(const ExpressionPtr& expression, std::string_view what);
  void constants(const Parameter& parameter);
  void loopBody(const Block& body, Known& known, bool runsOnce);
  // A touch of an earlier run of the loop may have found something that one of a later run does not.
  void forgetTouches(const Block& body, Known& known) const;
  void touch(const Touch& touch, const Statement& statement, Known& known);
  void move(const Move& move, const Statement& statement, Known& known);
  void assign(const Assign& assign, Known& known);
  void gives(const Name& name, Symbol symbol, Known& known);
  void finish(const Known& known, SourceRange where);

  // ---- CheckCalls.cpp
  void call(const Call& call, Known& known);
  void argument(const Argument& argument, const Parameter& parameter, const Known& known);
  bool callsItself(const File& file, std::set<const File*>& seen) const;

  // ---- CheckExpressions.cpp
  // The kind of a value, read where `known` holds. `known` gains what a condition says of its right operand
  // only within it.
  Quantity quantity(const Expression& expression, const Known& known);
  Quantity binary(const Expression& expression, const Binary& binary, const Known& known);
  Quantity name(const Expression& expression, const NameUse& use, const Known& known);
  Quantity member(const Expression& expression, const Member& member, const Known& known);
  Quantity function(const Expression& expression, const Function& function, const Known& known);
  Quantity choice(const Expression& expression, const Quantity& of, const Known& known);
  // Reports a value that is not what is wanted there; `what` is the place: "the distance".
  void want(const Expression& expression, Quantity wanted, std::string_view what, const Known& known);
  void wantFlag(const Expression& expression, std::string_view where, const Known& known);
  void wantAxis(const Expression& expression, Axis axis, std::string_view what, const Known& known);
  void mismatch(const Expression& left, const Quantity& a, const Expression& right, const Quantity& b,
                SourceRange where, std::string_view doing);
  std::string wholeComparison(const Binary& join) const;
  void unknownName(SourceRange range, const std::string& name);
  // A value of what nothing gave its name: of a touch without one, reported there.
  bool unnamedTouch(const Member& member);
  // The optional parameters that are given where the condition is true, or where it is false.
  void addGiven(const Expression& condition, bool truth, Known& known) const;

  std::string text(SourceRange range) const { return sources_.textUtf8(range); }

  const File& file_;
  const SourceMap& sources_;
  Diagnostics& diagnostics_;
  Symbols symbols_;
  int nameHints_ = 0; // names looked up for "did you mean"
  std::map<std::string, Symbol::Role, std::less<>> later_;
  std::set<std::string, std::less<>> mayMiss_; // touches whose `else` may go on
  // Parameters and results, wherever they are declared.
  std::map<std::string, SourceRange, std::less<>> below_;
  std::vector<SourceRange> unnamed_;    // touches without a name, in their order
  std::map<std::string, Name> letters_; // that parameters wish for, and the first of each
  bool inClause_ = false;               // of a parameter
  std::set<std::string, std::less<>>
      unreadable_; // words of lines that could not be read: they may give names
  // Where `use` brought the declarations that are being taken; no place: they are the file's own.
  SourceRange used_;
  bool options_ = false; // a file of options
  bool needsProbe_ = false;
  int depth_ = 0; // of blocks: 1 in the file itself
};

} // namespace dotek::frontend::cycle
