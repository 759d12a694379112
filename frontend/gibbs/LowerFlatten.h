// Flattens a macro: walks its instructions once for each combination of what is known when translating
// (which macro is called from where, which data a variable stands for, texts, unit of angles).
#pragma once

#include "frontend/gibbs/Lower.h"
#include "frontend/gibbs/LowerFlat.h"
#include "frontend/gibbs/RunMachine.h"

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace dotek::frontend::gibbs {

// A number of the run, or (null pointer) what is known when translating: a text, data of the CAM.
struct Lowered {
  ir::ExpressionPtr number;
  Value fixed = 0.0;
};

class Flattener {
public:
  Flattener(ir::Cycle& cycle, LowerContext& context, Purpose purpose);
  Flat flatten(const Macro& macro);

private:
  struct LoopAt {
    std::size_t index = 0;    // in Program::loops
    std::size_t instance = 0; // in loops_
    bool operator==(const LoopAt&) const = default;
  };
  struct Frame {
    const Program* program = nullptr;
    std::size_t at = 0;
    std::size_t instance = 0;     // tells the locals of calls apart
    std::set<std::string> locals; // declared, folded
    std::vector<LoopAt> loops;    // outermost first
    const Name* onError = nullptr;
    SourceRange called; // the CALL; no place in the outermost
  };
  struct State {
    std::vector<Frame> frames;
    std::map<std::string, Value> fixed; // by key of the variable
    std::set<std::string> written;      // host inputs that a SET_ command has changed
    std::optional<ir::AngleUnit> angles;
    std::set<std::string> dialogs;  // shown
    std::set<std::string> shadowed; // fields that were assigned before the first dialog
    std::set<std::string> changed;  // fields that were assigned behind it
  };
  struct LoopInstance {
    ir::ExpressionPtr end;
    double step = 1;
    std::set<ir::VariableId> bounds;  // variables that the end is computed from
    std::set<ir::VariableId> changed; // variables that are assigned while it runs
    SourceRange endRange;
  };
  enum class Flow : std::uint8_t { Next, Jumped, Ended, Failed };

  // ---- LowerFlatten.cpp: ways through the macro
  const Program& programOf(const Macro& macro);
  std::string keyOf(const State& state) const;
  std::size_t idOf(const State& state);
  std::size_t later(State state); // gives the id of the state, which will be placed
  void follow(State state);
  bool full() const;
  void emit(SourceRange range, decltype(FlatStep::step) step);
  Flow step(State& state, const Instruction& instruction);
  Flow branch(State& state, const BranchStep& s, SourceRange range);
  Flow jump(State& state, std::size_t target, SourceRange range);
  Flow jumpTo(State& state, const Name& label, SourceRange range);
  Flow loop(State& state, const ForStep& s, SourceRange range);
  bool enterLoop(State& state, std::size_t index);
  Flow next(State& state, const NextStep& s, SourceRange range);
  Flow call(State& state, const CallStep& s, SourceRange range);
  Flow declare(State& state, const Declaration& declaration);
  void ended(State& state);
  void leaveFrame(State& state);
  void resolve();
  void checkLoopEnds();

  // ---- LowerCommand.cpp
  Flow command(State& state, const Command& c, SourceRange range);
  Flow showMessage(State& state, const Command& c, SourceRange range);
  // Name under which the dialog counts as shown; nullopt: failed.
  std::optional<std::string> dialogName(State& state, const Command& c, SourceRange range,
                                        const Dialog** dialog);
  bool showsDialogAgain(State& state);
  Flow showDialog(State& state, const Command& c, SourceRange range);
  bool takeInputs(State& state, const Dialog* dialog, SourceRange range);
  bool storeField(State& state, const std::string& field, SourceRange range);
  Flow needsUser(const Command& c, const std::string& name);
  Flow swapValues(State& state, const Command& c, SourceRange range);
  Flow addMove(State& state, const Command& c, SourceRange range);
  Flow unknownCommand(State& state, const Command& c, const std::string& name);
  Flow tableCommand(State& state, const Command& c, const std::string& name);
  Value dataValue(State& state, const Command& c, const stdlib::CommandSignature& signature,
                  const std::string& name, bool text);

  // ---- LowerExpression.cpp; nothing: `failure_` says why
  std::optional<Lowered> lower(State& state, const Expression& e);
  std::optional<Lowered> binary(State& state, const Binary& node, SourceRange range);
  std::optional<Lowered> function(State& state, const FunctionCall& call, SourceRange range);
  std::optional<ir::ExpressionPtr> angleFunction(const State& state, const std::string& name,
                                                 const std::vector<Lowered>& arguments, SourceRange range);
  std::optional<Lowered> read(State& state, const VariableRef& ref);
  // The number at run time; data of the CAM that are no host input fail.
  std::optional<ir::ExpressionPtr> number(const Lowered& value, SourceRange range);
  std::optional<ir::ExpressionPtr> lowerNumber(State& state, const Expression& e);
  std::optional<ir::ConditionPtr> condition(State& state, const Condition& c);
  std::optional<ir::ConditionPtr> comparison(State& state, const Comparison& c);
  bool write(State& state, const VariableRef& ref, const Lowered& value, SourceRange range);
  bool assumes(std::string_view assumption, SourceRange range);
  std::string fixedKey(const State& state, const std::string& folded) const;
  ir::VariableId variableOf(const std::string& key, const Name& name);
  ir::VariableId freshLocal(const std::string& key, const std::string& name);
  bool mayFail(const State& state, SourceRange range);

  template <class Id, class... Args> void fail(SourceRange range, const Args&... args) {
    if (!failure_) failure_ = makeDiagnostic<Id>(range, args...);
  }

  ir::Cycle& cycle_;
  LowerContext& context_;
  Purpose purpose_;
  RunContext compiling_;
  std::map<const Macro*, std::unique_ptr<const Program>> programs_;
  std::map<std::string, ir::VariableId> fields_;    // by folded name
  std::map<std::string, ir::VariableId> variables_; // by key
  std::set<std::string> names_;                     // of variables, folded
  std::map<std::string, std::size_t> instances_;    // of calls
  std::map<std::string, std::size_t> loopIds_;
  std::vector<LoopInstance> loops_;
  std::map<std::string, std::size_t> states_; // key to id
  std::vector<std::size_t> placeOf_;          // of states by id; kNowhere: not placed
  std::map<std::pair<std::vector<std::size_t>, std::size_t>, State> waiting_;
  std::vector<std::size_t> runningLoops_; // of the state that is followed
  std::size_t keyBytes_ = 0;
  Flat flat_;
  std::optional<Diagnostic> failure_;
  bool lenient_ = false; // arguments without an effect: what is not set is merely unknown
};

} // namespace dotek::frontend::gibbs
