// The macro language on numbers: one path runs until it ends, or asks about something unknown.
#pragma once

#include "frontend/gibbs/Interpreter.h"

#include <optional>
#include <string>
#include <vector>

namespace dotek::frontend::gibbs {

struct ShownMessage {
  Rejection shown;
  std::size_t earlier = kNoMessage;
};

// How a stretch of a path ended.
enum class PathEnd : std::uint8_t {
  Ended,   // the macro is through
  Stopped, // STOP
  DialogAgain,
  Asks,      // `question()` is open: continue with copies that take an answer
  NeedsUser, // reported
  Failed,    // reported
};

class Machine final : public Interpreter {
public:
  Machine(RunContext& context, Purpose purpose) : Interpreter(context, purpose), context_(context) {
    around_.hosts = &context.hosts;
    around_.programs = context.programs;
  }

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

private:
  // ---- RunMachine.cpp
  Flow handleFault(State& state);
  bool leaveFrame(State& state);
  std::optional<bool> loopGoesOn(State& state, const Value& value, const Value& end, double step,
                                 SourceRange range);
  void refuse(SourceRange range, std::string_view why) override;
  Flow fork(State& state, const ir::ConditionPtr& condition, std::size_t otherwise,
            SourceRange range) override;
  bool openLoop(State& state, std::size_t index, const Value& end, double step) override;
  Flow advance(State& state, const Loop& loop, const VariableRef& variable, const Value& before,
               SourceRange range) override;
  Flow enter(State& state, Frame frame, const CallMacro& call, const Macro& macro,
             std::vector<Value> arguments) override;
  Flow takeArguments(State& state, const Args& args, SourceRange range) override;
  bool declareArray(State& state, const VariableRef& ref, Scope scope) override;

  // ---- RunCommands.cpp
  Flow show(State& state, const Command& c, const std::vector<std::optional<std::string>>& parts,
            SourceRange range) override;
  Flow needsUser(const Command& c, const std::string& name) override;
  void dialogOpens(State& state, SourceRange range) override;
  bool storeField(State& state, const std::string& field, SourceRange range) override;
  bool storeFields(State& state, SourceRange range) override;
  std::optional<Value> coordinate(const Value& value, SourceRange range) override;
  bool addMove(PathMove::Kind kind, const std::array<std::optional<Value>, 3>& axes,
               SourceRange range) override;
  void fillArray(State& state, const VariableRef& ref, const std::string& reason) override;

  // ---- RunValue.cpp
  Value opaque(State& state, std::string name, const std::vector<Value>& from, const std::string& reason,
               bool text, SourceRange range) override;
  Value literal(double value, const std::string&, SourceRange) override { return value; }
  std::optional<Value> combine(State& state, const Binary& node, const Value& left, const Value& right,
                               SourceRange range) override;
  std::optional<Value> apply(State& state, const NumberFunction& function,
                             const std::vector<Value>& arguments, SourceRange range) override;
  std::optional<Truth> compareNumbers(State& state, const Comparison& c, const Value& left,
                                      const Value& right) override;
  std::optional<Truth> compareTexts(State& state, const Comparison& c, const Value& left,
                                    const Value& right) override;
  std::optional<bool> compare(State& state, const Value& left, Relation relation, const Value& right,
                              SourceRange range);
  std::optional<bool> ask(const State& state, Question question);
  std::optional<std::string> element(State& state, const std::string& key, const VariableRef& ref,
                                     bool reads) override;
  bool isField(const std::string& key) const override { return context_.fields.contains(key); }
  std::optional<Value> lookUp(State& state, const std::string& key, const VariableRef& ref) override;
  bool store(State& state, const std::string& key, const VariableRef& ref, Value value,
             SourceRange range) override;

  RunContext& context_;
  std::vector<ShownMessage> messages_;
  std::size_t messageBytes_ = 0;
  std::vector<PathMove> moves_;
  std::size_t steps_ = 0;
  SourceRange place_;
  std::optional<Question> question_;
};

} // namespace dotek::frontend::gibbs
