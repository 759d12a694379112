// Flattens a macro: walks its instructions once for each combination of what is known when translating
// (which macro is called from where, which data a variable is, texts, unit of angles).
#pragma once

#include "frontend/gibbs/Interpreter.h"
#include "frontend/gibbs/Lower.h"
#include "frontend/gibbs/LowerFlat.h"

#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

namespace dotek::frontend::gibbs {

// Numbers of the run are expressions of the IR; the other values are known when translating: texts, data of
// the CAM.
class Flattener final : public Interpreter {
public:
  Flattener(ir::Cycle& cycle, LowerContext& context, Purpose purpose);
  Flat flatten(const Macro& macro);

private:
  struct LoopInstance {
    ir::ExpressionPtr end;
    double step = 1;
    std::set<ir::VariableId> bounds;  // variables that the end is computed from
    std::set<ir::VariableId> changed; // variables that are assigned while it runs
    SourceRange endRange;
  };

  // What a variable of the program was made for.
  struct VariableKey {
    enum class Kind : std::uint8_t {
      Global,
      Local,   // of the call `instance`
      Shadow,  // of a field that was assigned before the first dialog
      LoopEnd, // of the loop `index` of the call `instance`
      Swap,
    };
    Kind kind = Kind::Global;
    std::string name; // folded
    std::size_t instance = 0;
    std::size_t index = 0;
    auto operator<=>(const VariableKey&) const = default;
  };

  // ---- LowerFlatten.cpp: paths through the macro
  std::string keyOf(const State& state) const;
  std::size_t idOf(const State& state);
  std::size_t later(State state); // gives the id of the state, which will be placed
  void follow(State state);
  bool full() const;
  void emit(SourceRange range, decltype(FlatStep::step) step);
  void ended(State& state);
  void leaveFrame(State& state);
  void resolve();
  void checkLoopEnds();
  bool showsDialogAgain(State& state);
  void refuse(SourceRange range, std::string_view why) override;
  Flow fork(State& state, const ir::ConditionPtr& condition, std::size_t otherwise,
            SourceRange range) override;
  Flow arrive(State& state, SourceRange range) override;
  bool openLoop(State& state, std::size_t index, const Value& end, double step) override;
  Flow advance(State& state, const Loop& loop, const VariableRef& variable, const Value& before,
               SourceRange range) override;
  Flow enter(State& state, Frame frame, const CallMacro& call, const Macro& macro,
             std::vector<Value> arguments) override;
  Flow takeArguments(State& state, const Args& args, SourceRange range) override;
  bool declareArray(State& state, const VariableRef& ref, Scope scope) override;
  void declared(State& state, const VariableRef& local) override;

  // ---- LowerCommand.cpp
  Flow show(State& state, const Command& c, const std::vector<std::optional<std::string>>& parts,
            SourceRange range) override;
  Flow stop(SourceRange range) override;
  Flow needsUser(const Command& c, const std::string& name) override;
  void dialogOpens(State& state, SourceRange range) override;
  Flow dialogAgain(State& state, SourceRange range) override;
  bool storeField(State& state, const std::string& field, SourceRange range) override;
  bool storeFields(State& state, SourceRange range) override;
  bool dialogCloses(State& state, SourceRange range) override;
  Value kept(const Value& value, SourceRange range) override;
  std::optional<Value> coordinate(const Value& value, SourceRange range) override;
  bool addMove(PathMove::Kind kind, const std::array<std::optional<Value>, 3>& axes,
               SourceRange range) override;
  Value writtenHost(State& state, const std::string& host, const std::string& reason,
                    SourceRange range) override;

  // ---- LowerExpression.cpp
  Value opaque(State& state, std::string name, const std::vector<Value>& from, const std::string& reason,
               bool text, SourceRange range) override;
  Value literal(double value, const std::string& digits, SourceRange range) override;
  std::optional<Value> combine(State& state, const Binary& node, const Value& left, const Value& right,
                               SourceRange range) override;
  std::optional<Value> apply(State& state, const NumberFunction& function,
                             const std::vector<Value>& arguments, SourceRange range) override;
  std::optional<Truth> compareNumbers(State& state, const Comparison& c, const Value& left,
                                      const Value& right) override;
  std::optional<Truth> compareTexts(State& state, const Comparison& c, const Value& left,
                                    const Value& right) override;
  std::optional<std::string> element(State& state, const std::string& key, const VariableRef& ref,
                                     bool reads) override;
  bool isField(const std::string& key) const override { return fields_.contains(key); }
  std::optional<Value> lookUp(State& state, const std::string& key, const VariableRef& ref) override;
  bool store(State& state, const std::string& key, const VariableRef& ref, Value value,
             SourceRange range) override;
  // The number at run time; data of the CAM that are no host input fail.
  std::optional<ir::ExpressionPtr> number(const Value& value, SourceRange range);
  // No number of the run: data that only the CAM knows, or nothing is to be emitted.
  bool isClosed(const Value& value) const;
  // The value of the variable where it is known when translating.
  std::optional<Value> fixed(const State& state, const std::string& name) const;
  void setFixed(State& state, const std::string& name, std::optional<Value> value);
  VariableKey keyFor(const State& state, const std::string& name) const;
  ir::VariableId variableOf(const VariableKey& key, const Name& name);
  ir::VariableId freshLocal(const VariableKey& key, const std::string& name);
  bool mayFail(const State& state, SourceRange range);

  ir::Cycle& cycle_;
  LowerContext& context_;
  std::map<std::string, ir::VariableId> fields_; // by folded name
  std::map<VariableKey, ir::VariableId> variables_;
  std::set<std::string> names_; // of variables, folded
  // Of calls: by instance and place of the CALL and the file that it names.
  std::map<std::tuple<std::size_t, std::size_t, FileId>, std::size_t> instances_;
  // By instance, index in Program::loops and, where it is one, constant end.
  std::map<std::tuple<std::size_t, std::size_t, std::optional<double>>, std::size_t> loopIds_;
  std::vector<LoopInstance> loops_;
  std::map<std::string, std::size_t> states_; // key to id
  std::vector<std::size_t> placeOf_;          // of states by id; kNowhere: not placed
  std::map<std::pair<std::vector<std::size_t>, std::size_t>, State> waiting_;
  std::vector<std::size_t> runningLoops_; // of the state that is followed
  std::size_t keyBytes_ = 0;
  Flat flat_;
};

} // namespace dotek::frontend::gibbs
