// The machine that runs compiled macros. A state is one path; it can be copied where a condition hangs on
// something unknown.
#pragma once

#include "frontend/gibbs/Program.h"
#include "frontend/gibbs/Run.h"
#include "frontend/gibbs/Value.h"
#include "ir/Arithmetic.h"

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace dotek::frontend::gibbs {

struct LoopRun {
  std::size_t index = 0; // in Program::loops
  Value end;
  double step = 1;
};

// One macro that runs, called or first.
struct Frame {
  const Program* program = nullptr;
  std::size_t at = 0;
  std::map<std::string, std::optional<Value>> locals; // declared; nothing: not assigned yet
  std::vector<LoopRun> loops;                         // outermost first
  const Name* onError = nullptr;
  std::optional<std::vector<Value>> arguments; // of CALL, until ARGS takes them
  SourceRange called;
};

inline constexpr std::size_t kNoMessage = kNowhere;

struct State {
  std::map<std::string, Value> globals;
  std::vector<Frame> frames;
  std::map<std::string, std::size_t> arrays; // declared number of elements
  std::map<std::string, Range> learnt;       // of unknowns, by question key
  std::map<std::string, Value> written;      // host inputs that a SET_ command has changed
  std::optional<ir::AngleUnit> angles;
  std::size_t message = kNoMessage;       // last one shown, in Machine::messages
  std::size_t messageBefore = kNoMessage; // last one before the first dialog
  std::set<std::string> dialogs;          // shown
  SourceRange jumped;                     // last GOTO
  SourceRange returnCodeSet;
  std::map<std::string, SourceRange> fieldSet; // last assignment to each field
  std::size_t fresh = 0;                       // unknowns without a name of their own
};

struct ShownMessage {
  Rejection shown;
  std::size_t earlier = kNoMessage;
};

enum class Purpose : std::uint8_t { Checks, ToolPath };

// How a stretch of a path ended.
enum class PathEnd : std::uint8_t {
  Ended,   // the macro is through
  Stopped, // STOP
  DialogAgain,
  Asks,      // `question()` is open: continue with copies that take an answer
  NeedsUser, // reported
  Failed,    // reported
};

// A mistake at run time that ON_ERROR may catch; reported only where it is not caught.
struct Fault {
  Diagnostic diagnostic;
  bool catchable = false;
};

class Machine {
public:
  Machine(RunContext& context, Purpose purpose) : context_(context), purpose_(purpose) {}

  State start(const Macro& macro);
  // Runs until the path ends or asks.
  PathEnd run(State& state);
  const Question& question() const { return *question_; }
  // Where the last statement stood.
  SourceRange place() const { return place_; }
  // Is `value` other than 0? nullopt: `question()` is open.
  std::optional<bool> isNonZero(State& state, const Value& value, SourceRange range);
  // Messages from the last one back to, not including, `until`; oldest first.
  std::vector<Rejection> messagesSince(const State& state, std::size_t until) const;
  std::vector<PathMove>& moves() { return moves_; }

  // Reports unless an error is there already at this place.
  void reportOnce(Diagnostic diagnostic);

private:
  // ---- RunMachine.cpp: statements
  // Failed: `fault_` or, without one, `question_` says why.
  enum class Flow : std::uint8_t { Next, Jumped, Failed, Stopped, DialogAgain, NeedsUser };
  Flow execute(State& state, const Instruction& instruction);
  Flow handleFault(State& state);
  bool leaveFrame(State& state);
  const Program& programOf(const Macro& macro);
  Flow jump(State& state, std::size_t target, SourceRange range);
  Flow jumpToLabel(State& state, const Name& label, SourceRange range);
  Flow step(State& state, const AssignStep& s, SourceRange range);
  Flow step(State& state, const BranchStep& s, SourceRange range);
  Flow step(State& state, const JumpStep& s, SourceRange range);
  Flow step(State& state, const ForStep& s, SourceRange range);
  Flow step(State& state, const NextStep& s, SourceRange range);
  Flow step(State& state, const GotoStep& s, SourceRange range);
  Flow step(State& state, const CallStep& s, SourceRange range);
  Flow step(State& state, const ArgsStep& s, SourceRange range);
  Flow step(State& state, const DeclareStep& s, SourceRange range);
  Flow step(State& state, const OnErrorStep& s, SourceRange range);
  Flow step(State& state, const CommandStep& s, SourceRange range);
  Flow step(State& state, const UnverifiedStep& s, SourceRange range);
  Flow step(State& state, const RefuseStep& s, SourceRange range);
  // Takes end and step of a FOR of the running macro.
  bool enterLoop(State& state, std::size_t index);
  std::optional<bool> loopGoesOn(State& state, const Value& value, const Value& end, double step,
                                 SourceRange range);

  // ---- RunCommands.cpp
  Flow command(State& state, const Command& c, SourceRange range);
  Flow showMessage(State& state, const Command& c, SourceRange range);
  Flow showDialog(State& state, const Command& c, SourceRange range);
  Flow needsUser(const Command& c, const std::string& name);
  Flow swapValues(State& state, const Command& c, SourceRange range);
  Flow addMove(State& state, const Command& c, SourceRange range);
  Flow unknownCommand(State& state, const Command& c, const std::string& name);
  Flow tableCommand(State& state, const Command& c, const std::string& name);
  Value dataValue(State& state, const Command& c, const stdlib::CommandSignature& signature,
                  const std::string& name, bool text);
  std::optional<double> coordinate(State& state, const Expression& e);

  // ---- Evaluate.cpp; nullopt: `fault_` or `question_` says why
  std::optional<Value> evaluate(State& state, const Expression& e);
  std::optional<Value> evaluateNumber(State& state, const Expression& e);
  std::optional<Value> evaluateText(State& state, const Expression& e);
  std::optional<Value> binary(State& state, const Binary& node, SourceRange range);
  std::optional<Value> read(State& state, const VariableRef& ref);
  std::optional<Value> readUnassigned(State& state, const std::string& key, const Name& name);
  std::optional<std::string> keyOf(State& state, const VariableRef& ref);
  bool write(State& state, const VariableRef& ref, Value value);
  std::optional<bool> decide(State& state, const Condition& condition);
  std::optional<bool> decide(State& state, const Comparison& comparison);
  std::optional<bool> compare(State& state, const Value& left, Relation relation, const Value& right,
                              SourceRange range);
  bool assumes(std::string_view assumption, SourceRange range);
  // `name`: what equal values share; "": this value is its own.
  Value opaque(State& state, std::string name, const std::vector<Value>& from, const std::string& reason,
               bool text);
  std::optional<Value> computed(ir::Computed result, SourceRange range);

  // ---- EvaluateFunctions.cpp
  std::optional<Value> function(State& state, const FunctionCall& call, SourceRange range);
  std::optional<Value> numberFunction(State& state, const std::string& name,
                                      const std::vector<Value>& arguments, SourceRange range, bool& known);
  std::optional<Value> textFunction(const std::string& name, const std::vector<Value>& arguments,
                                    SourceRange range, bool& known);

  template <class Id, class... Args> void fault(SourceRange range, bool catchable, const Args&... args) {
    fault_ = Fault{makeDiagnostic<Id>(range, args...), catchable};
  }

  RunContext& context_;
  Purpose purpose_;
  std::map<const Macro*, std::unique_ptr<const Program>> programs_;
  std::vector<ShownMessage> messages_;
  std::size_t messageBytes_ = 0;
  std::vector<PathMove> moves_;
  std::size_t steps_ = 0;
  SourceRange place_;
  std::optional<Fault> fault_;
  std::optional<Question> question_;
  bool lenient_ = false; // arguments without an effect: what is not set is merely unknown
};

} // namespace dotek::frontend::gibbs
