// What the statements, commands and expressions of the macro language mean, over two domains of values:
// Machine runs them on numbers, Flattener lowers them to the IR. A member that fails returns nothing, false
// or Flow::Failed, and `fault_` (in a run also `question_`) says why.
#pragma once

#include "frontend/gibbs/Functions.h"
#include "frontend/gibbs/Program.h"
#include "frontend/gibbs/Run.h"
#include "frontend/gibbs/Value.h"
#include "ir/Arithmetic.h"

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace dotek::frontend::gibbs {

struct LoopRun {
  std::size_t index = 0;    // in Program::loops
  Value end = 0.0;          // of a run
  double step = 1;          // of a run
  std::size_t instance = 0; // of a translation
};

// One macro that runs, called or first.
struct Frame {
  const Program* program = nullptr;
  std::size_t at = 0;
  // Declared. Nothing: in a run not assigned yet, in a translation a variable of the program.
  std::map<std::string, std::optional<Value>> locals;
  std::vector<LoopRun> loops; // outermost first
  const Name* onError = nullptr;
  SourceRange called;                          // the CALL; no place in the outermost
  std::optional<std::vector<Value>> arguments; // of a run: of CALL, until ARGS takes them
  std::size_t instance = 0;                    // of a translation: tells the locals of calls apart
};

inline constexpr std::size_t kNoMessage = kNowhere;

// One path; it can be copied where a condition depends on something unknown.
struct State {
  std::vector<Frame> frames;
  // In a run what was assigned, other fields of the cycle aside; in a translation what is known when
  // translating.
  std::map<std::string, Value> globals;
  std::map<std::string, std::size_t> arrays; // declared number of elements
  std::map<std::string, Value> written;      // host inputs that a SET_ command has changed
  std::optional<ir::AngleUnit> angles;
  std::set<std::string> dialogs; // shown
  SourceRange jumped;            // last GOTO

  // ---- of a run
  std::map<std::string, Range> learnt;    // of unknowns, by question key
  std::size_t message = kNoMessage;       // last one shown, in Machine::messages
  std::size_t messageBefore = kNoMessage; // last one before the first dialog
  SourceRange returnCodeSet;
  std::map<std::string, SourceRange> fieldSet; // last assignment to each field
  std::size_t fresh = 0;                       // unknowns without a name of their own

  // ---- of a translation
  // Fields that were assigned before the first dialog, with values as of locals.
  std::map<std::string, std::optional<Value>> shadowed;
  std::set<std::string> changed; // fields that were assigned after it
};

enum class Purpose : std::uint8_t { Checks, ToolPath };

// A mistake at run time that ON_ERROR may catch; reported only where it is not caught.
struct Fault {
  Diagnostic diagnostic;
  bool catchable = false;
};

// Of a condition: known, or decided by the translated program.
using Truth = std::variant<bool, ir::ConditionPtr>;

class Interpreter {
public:
  // Reports unless an error is there already at this place.
  void reportOnce(Diagnostic diagnostic);

protected:
  // Next: go on after the statement. Jumped: the frames say where to go on. The others end the path.
  enum class Flow : std::uint8_t { Next, Jumped, Ended, Failed, Stopped, DialogAgain, NeedsUser };
  using DialogLoader = std::function<const Dialog*(const std::string& name, SourceRange where)>;

  // What both contexts hold; the context outlives the interpreter.
  struct Surroundings {
    const SourceMap& sources;
    const stdlib::GibbsKeywords& keywords;
    const Limits& limits;
    Diagnostics& diagnostics;
    const std::set<std::string>& assumptions;
    const MacroLoader& load;
    const DialogLoader& loadDialog;
    const std::map<std::string, double>* hosts = nullptr; // host inputs that are known; nullptr: none
    Programs* programs = nullptr;                         // kept from run to run; nullptr: none
  };

  template <class Context>
  Interpreter(Context& context, Purpose purpose)
      : around_{context.sources,     context.keywords, context.limits,    context.diagnostics,
                context.assumptions, context.load,     context.loadDialog},
        purpose_(purpose) {}
  Interpreter(const Interpreter&) = delete;
  Interpreter& operator=(const Interpreter&) = delete;
  virtual ~Interpreter() = default;

  // ---- InterpretFlow.cpp
  const Program& programOf(const Macro& macro);
  Flow step(State& state, const Instruction& instruction);
  Flow jump(State& state, std::size_t target, SourceRange range);
  Flow jumpToLabel(State& state, const Name& label, SourceRange range);
  // The file and place of a DIALOG without a name, or the folded name that it gives; `dialog` may be null.
  std::optional<std::string> dialogName(State& state, const Command& c, SourceRange range,
                                        const Dialog** dialog);

  // ---- InterpretExpression.cpp
  std::optional<Value> evaluate(State& state, const Expression& e);
  std::optional<Value> evaluateNumber(State& state, const Expression& e);
  std::optional<Value> evaluateText(State& state, const Expression& e);
  std::optional<Truth> decide(State& state, const Condition& condition);
  std::optional<Value> read(State& state, const VariableRef& ref);
  bool write(State& state, const VariableRef& ref, Value value, SourceRange range);
  bool assumes(std::string_view assumption, SourceRange range);
  // A result of arithmetic; what has none is a fault that ON_ERROR catches.
  std::optional<Value> computed(ir::Computed result, SourceRange range);

  template <class Id, class... Args> void fault(SourceRange range, bool catchable, const Args&... args) {
    fault_ = Fault{makeDiagnostic<Id>(range, args...), catchable};
  }

  Surroundings around_;
  Purpose purpose_;
  std::optional<Fault> fault_;
  bool lenient_ = false; // arguments without an effect: what is not set is merely unknown

  // A field of the cycle, by its folded name.
  virtual bool isField(const std::string& key) const = 0;
  // Whether the name is one of the CAM, where no local variable has it.
  bool isOfCam(const std::string& key) const;

private:
  // ---- what the domains decide, where it is no matter of course in a run: values
  // `name`: what equal values share; "": this value, made at `range`, is its own.
  virtual Value opaque(State& state, std::string name, const std::vector<Value>& from,
                       const std::string& reason, bool text, SourceRange range) = 0;
  virtual Value literal(double value, const std::string& digits, SourceRange range) = 0;
  // Of numbers. Nothing without a fault: the result is opaque.
  virtual std::optional<Value> combine(State& state, const Binary& node, const Value& left,
                                       const Value& right, SourceRange range) = 0;
  virtual std::optional<Value> apply(State& state, const NumberFunction& function,
                                     const std::vector<Value>& arguments, SourceRange range) = 0;
  virtual std::optional<Truth> compareNumbers(State& state, const Comparison& c, const Value& left,
                                              const Value& right) = 0;
  // One of the texts is not known.
  virtual std::optional<Truth> compareTexts(State& state, const Comparison& c, const Value& left,
                                            const Value& right) = 0;

  // ---- variables
  // Key of an element of an array.
  virtual std::optional<std::string> element(State& state, const std::string& key, const VariableRef& ref,
                                             bool reads) = 0;
  // nothing: no value is set.
  virtual std::optional<Value> lookUp(State& state, const std::string& key, const VariableRef& ref) = 0;
  virtual bool store(State& state, const std::string& key, const VariableRef& ref, Value value,
                     SourceRange range) = 0;

  // ---- flow
  // "{}; the run ends here", "{}, and a program cannot do the same".
  virtual void refuse(SourceRange range, std::string_view why) = 0;
  // Goes on where the condition holds, else at `otherwise`.
  virtual Flow fork(State& state, const ir::ConditionPtr& condition, std::size_t otherwise,
                    SourceRange range) = 0;
  // A jump that has set the place.
  virtual Flow arrive(State&, SourceRange) { return Flow::Jumped; }
  virtual bool openLoop(State& state, std::size_t index, const Value& end, double step) = 0;
  // The NEXT of the innermost loop that runs; `before`: value of its variable.
  virtual Flow advance(State& state, const Loop& loop, const VariableRef& variable, const Value& before,
                       SourceRange range) = 0;
  virtual Flow enter(State& state, Frame frame, const CallMacro& call, const Macro& macro,
                     std::vector<Value> arguments) = 0;
  virtual Flow takeArguments(State& state, const Args& args, SourceRange range) = 0;
  virtual bool declareArray(State& state, const VariableRef& ref, Scope scope) = 0;
  virtual void declared(State&, const VariableRef& /*local*/) {}

  // ---- commands
  // Parts of a MESSAGE; nothing: not known.
  virtual Flow show(State& state, const Command& c, const std::vector<std::optional<std::string>>& parts,
                    SourceRange range) = 0;
  virtual Flow stop(SourceRange) { return Flow::Stopped; }
  virtual Flow needsUser(const Command& c, const std::string& name) = 0;
  virtual void dialogOpens(State& state, SourceRange range) = 0;
  virtual Flow dialogAgain(State&, SourceRange) { return Flow::DialogAgain; }
  // A field, or each, takes the value that was typed in.
  virtual bool storeField(State& state, const std::string& field, SourceRange range) = 0;
  virtual bool storeFields(State& state, SourceRange range) = 0;
  virtual bool dialogCloses(State&, SourceRange) { return true; }
  // The value, safe from what is assigned to the variable that it was read from.
  virtual Value kept(const Value& value, SourceRange) { return value; }
  virtual std::optional<Value> coordinate(const Value& value, SourceRange range) = 0;
  // Not written axes have no value.
  virtual bool addMove(PathMove::Kind kind, const std::array<std::optional<Value>, 3>& axes,
                       SourceRange range) = 0;
  // Elements of a list that a command fills.
  virtual void fillArray(State&, const VariableRef&, const std::string& /*reason*/) {}
  virtual Value writtenHost(State& state, const std::string& host, const std::string& reason,
                            SourceRange range);

  // ---- InterpretFlow.cpp
  Flow loop(State& state, const ForStep& s, SourceRange range);
  bool enterLoop(State& state, std::size_t index);
  Flow next(State& state, const NextStep& s, SourceRange range);
  Flow call(State& state, const CallStep& s, SourceRange range);
  Flow declare(State& state, const Declaration& declaration);

  // ---- InterpretCommand.cpp
  Flow command(State& state, const Command& c, SourceRange range);
  Flow showMessage(State& state, const Command& c, SourceRange range);
  Flow showDialog(State& state, const Command& c, SourceRange range);
  bool takeInputs(State& state, const Dialog* dialog, SourceRange range);
  Flow swapValues(State& state, const Command& c, SourceRange range);
  Flow addMove(State& state, const Command& c, SourceRange range);
  Flow unknownCommand(State& state, const Command& c, const std::string& name);
  Flow tableCommand(State& state, const Command& c, const std::string& name);
  Value dataValue(State& state, const Command& c, const stdlib::CommandSignature& signature,
                  const std::string& name, bool text);
  std::optional<Value> evaluateLeniently(State& state, const Expression& e);
  const double* knownHost(const std::string& name) const;

  // ---- InterpretExpression.cpp
  std::optional<Value> evaluate(State&, const NumberLiteral& literal, SourceRange range);
  std::optional<Value> evaluate(State&, const TextLiteral& literal, SourceRange range);
  std::optional<Value> evaluate(State& state, const VariableRef& ref, SourceRange);
  std::optional<Value> evaluate(State& state, const FunctionCall& call, SourceRange range);
  std::optional<Value> evaluate(State& state, const Unary& node, SourceRange range);
  std::optional<Value> evaluate(State& state, const Binary& node, SourceRange range);
  std::optional<Value> evaluate(State& state, const Bracketed& node, SourceRange);
  std::optional<Value> evaluate(State&, const ErrorExpression&, SourceRange range);
  std::optional<Truth> decide(State& state, const Comparison& c);
  std::optional<std::string> keyOf(State& state, const VariableRef& ref, bool reads);

  Programs programs_;
};

} // namespace dotek::frontend::gibbs
