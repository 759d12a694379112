// One cycle as it becomes IR, with the cycles that it calls.
#pragma once

#include "frontend/cycle/Lower.h"

#include "ir/CycleNames.h"
#include "ir/Positions.h"

#include <array>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace dotek::frontend::cycle {

ir::Kind kindOfType(TypeName type);

// What a name stands for while a cycle is lowered.
struct Meaning {
  ir::ExpressionPtr value;                // that reading it gives; nullptr: of a touch or a call
  std::optional<ir::VariableId> variable; // that an assignment writes
  const std::vector<Name>* choices = nullptr;
  ir::Kind kind = ir::Kind::Number;
  std::optional<bool> given;                                // of an optional parameter, where it is certain
  std::map<std::string, Meaning, std::less<>> members = {}; // of a touch or a call
};

// The names of one cycle: of the one that is lowered, or of one that is written in the place of its call.
struct Scope {
  std::string prefix; // of its variables: "hole_"; "" of the outermost
  bool inlined = false;
  bool keepsProbe = false; // the caller has switched the probe on, and switches it off
  std::map<std::string, Meaning, std::less<>> names = {};
  // Where a cycle began that was called, work coordinates; empty: nothing has asked.
  std::array<std::optional<ir::VariableId>, 3> start = {};
  std::size_t begin = 0;         // index in the body of its first statement, of one that was called
  std::array<bool, 3> shifted{}; // a `set` since it began may have moved its coordinates
};

ir::ToolPart partOf(ToolPart part);
// Among the names of a scope: whether the touch found anything. No name of a cycle holds a blank.
inline std::string foundName(const std::string& touch) {
  return "given " + touch;
}

std::optional<ir::Axis> linear(Axis axis); // nothing: a rotary axis

// The called cycles that are programs of their own, of one command.
struct Programs {
  struct Key {
    const File* file = nullptr;
    bool probeOn = false;     // the caller has switched the probe on
    std::uint32_t levels = 0; // of programs that it may call itself
    auto operator<=>(const Key&) const = default;
  };
  std::vector<CalledProgram> list;
  std::map<Key, std::optional<std::size_t>> byKey; // nothing: it cannot be one
  std::vector<CallInPlace> inPlace;
};

class Lowering {
public:
  Lowering(const File& file, const SourceMap& sources, Diagnostics& diagnostics);
  // Calls become programs, so many levels deep.
  void callPrograms(Programs& programs, std::uint32_t levels) {
    programs_ = &programs;
    levels_ = levels;
  }
  // Calls of these become calls of macros.
  void callMacros(const std::map<const File*, MacroCycle>& macros) { macros_ = &macros; }
  // It is one of the programs itself.
  void beCalled(bool probeOn);
  std::optional<Lowered> run();

private:
  enum class Probe : std::uint8_t { Off, On, Either };

  template <class Id, class... Args> void refuse(SourceRange range, const Args&... args) {
    failed_ = true;
    report(makeDiagnostic<Id>(range, args...));
  }
  // Of a called cycle at the call, which is what the author can change.
  void report(Diagnostic diagnostic) {
    if (site_ != 0) {
      diagnostic.note(diagnostic.range, "the line of the called cycle");
      diagnostic.range = sites_[site_ - 1].range;
    }
    diagnostics_.add(std::move(diagnostic));
  }
  template <class Node> ir::CycleStatement& emit(Node node, SourceRange range, std::string reason = "") {
    ir::CycleStatement& added = out_->emplace_back();
    added.node = std::move(node);
    added.origin.ranges = {range};
    added.origin.reason = std::move(reason);
    added.origin.place = site_; // until it is done
    return added;
  }
  void place(ir::LabelId label, SourceRange range) { emit(ir::Label{label}, range); }
  void jump(ir::LabelId label, SourceRange range);
  ir::LabelId label(std::string_view name, SourceRange range);
  ir::VariableId local(std::string_view name, ir::Kind kind, SourceRange range);
  std::string text(SourceRange range) const { return sources_.textUtf8(range); }

  // ---- LowerDeclarations.cpp
  void declarations(const File& file);
  void parameter(const Parameter& parameter, bool inlined, const Call* call);
  void declareParameter(const Parameter& parameter, const Name& name);
  void clauses(const Parameter& parameter);
  void result(const Result& result);
  // An alarm unless the condition holds.
  void demand(const Expression& condition, const std::string& message, SourceRange range);
  bool isDemanded(const ir::CycleStatement& check);
  bool isParameter(ir::VariableId id) const;
  void bound(const Expression& condition);
  static std::string alarmText(const std::string& name);

  // ---- LowerExpression.cpp
  // Statements that compute parts of the value are emitted first. `choices`: what it is one of, where the
  // place says so.
  ir::ExpressionPtr value(const Expression& expression, const std::vector<Name>* choices = nullptr);
  ir::ExpressionPtr binary(const Expression& expression, const Binary& binary);
  ir::ExpressionPtr function(const Expression& expression, const Function& function);
  ir::ExpressionPtr name(const Expression& expression, const NameUse& use, const std::vector<Name>* choices);
  ir::ExpressionPtr member(const Expression& expression, const Member& member);
  // T.radius of a tool offset; nothing: a member of something else.
  std::optional<ToolPart> toolPart(const Member& member) const;
  ir::ExpressionPtr flag(const Expression& expression);
  ir::ExpressionPtr least(const ir::ExpressionPtr& a, const ir::ExpressionPtr& b, bool greatest,
                          SourceRange range);
  ir::ExpressionPtr towards(const ir::ExpressionPtr& value, bool up, SourceRange range);
  // The value in a variable, where it is more than a constant or a variable.
  ir::ExpressionPtr kept(const ir::ExpressionPtr& value, std::string_view name, ir::Kind kind,
                         SourceRange range);
  const Meaning* meaningOf(const Expression& expression) const;
  const std::vector<Name>* choicesOf(const Expression& expression) const;
  ir::Kind kindOf(const Expression& expression) const;
  bool isFlag(const Expression& expression) const;
  // A condition that is written out.
  bool isLogicValue(const Expression& expression) const;
  // Jumps to `target` where the condition is `when`, else goes on.
  void branch(const Expression& condition, bool when, ir::LabelId target);
  ir::ConditionPtr condition(const Expression& expression);
  // What the condition is whatever the values are.
  std::optional<bool> decided(const Expression& condition) const;
  // It is one condition of the IR: without statements before a part of it, or a part that guards another.
  bool isSimple(const Expression& condition) const;

  // ---- LowerStatement.cpp
  using Results = std::vector<std::pair<std::string, ir::VariableId>>;
  // The results that got a value in it and in nothing before.
  Results block(const Block& block);
  void statement(const Statement& statement);
  void comments(const std::vector<Comment>& list);
  void move(const Move& move, SourceRange range);
  void touch(const Touch& touch, SourceRange range);
  void touchCall(const Touch& touch, SourceRange range);
  void readTouch(const Touch& touch, SourceRange range);
  // `given NAME` of a touch: no until one of that name has found something.
  void declareTouches(const Block& block);
  void noteFound(const Touch& touch, bool found, SourceRange range);
  // A cycle by its name that moves nothing.
  ir::CallCycle quiet(std::string_view name) const;
  void setOffset(const SetOffset& set, SourceRange range);
  void leaveResults(const Results& results, SourceRange range);
  void report(const Report& report, SourceRange range);
  void assign(const Assign& assign, SourceRange range);
  void probe(const ProbeSwitch& probe, SourceRange range);
  void choose(const If& choice, SourceRange range);
  void repeat(const Repeat& repeat, SourceRange range);
  void count(const For& loop, SourceRange range);
  bool isWhole(const Expression& expression) const;
  void loop(const While& loop, SourceRange range);
  void loopBody(const Block& body);
  // Axes whose coordinates a `set` of the block, or of what it calls, may move. `absent`: optional parameters
  // that the call leaves out.
  void noteShifts(const Block& block, const std::set<std::string>& absent);
  bool ended() const;

  // ---- LowerCall.cpp
  void call(const Call& call, SourceRange range);
  // As the call of a macro; false: none carries out the cycle, or one with these arguments.
  bool callMacro(const Call& call, SourceRange range);

  // ---- LowerPrograms.cpp
  struct Outline { // a call that may be one of a program, between two labels of the body
    ir::LabelId begin = 0, end = 0;
    SourceRange range;
    const File* called = nullptr;
    bool probeOn = false;
    std::vector<std::pair<std::string, ir::ExpressionPtr>> arguments;
    std::vector<std::pair<std::string, ir::VariableId>> results;
  };
  bool isProgram(const Call& call) const;
  // Puts calls of programs in the place of what the calls came to.
  void outline();
  struct Region; // of the body
  std::vector<Region> regions() const;
  std::optional<std::size_t> programOf(const Outline& call, std::string& why);
  // Variables that the rest reads and only the call assigns, or both: what it does is no program then.
  void keepEntangled(std::vector<Region>& regions) const;
  ir::CallCycle callOf(const Region& region, const std::vector<ir::Position>& known);

  // ---- LowerPlaces.cpp
  // Where the probe is along the axis, as a value.
  ir::ExpressionPtr here(ir::Axis axis, SourceRange range);
  // Where the cycle of the scope began.
  ir::ExpressionPtr start(ir::Axis axis, SourceRange range);
  ir::ExpressionPtr host(std::string_view name, ir::Kind kind);
  void moveToStart(const Move& move, SourceRange range);
  // Puts in what was asked for above, when all moves are known.
  void resolvePlaces();
  void toStart(const ir::CycleStatement& marked, const ir::ExpressionPtr& height,
               const std::array<bool, 3>& same);
  ir::ExpressionPtr awayFrom(const ir::AxisPosition& at, ir::VariableId start) const;
  bool lasts(const ir::ExpressionPtr& value) const;
  void refuseShiftedStarts();
  struct Sign {
    bool above = false, below = false; // certainly 0 or more, 0 or less
    bool apart = false;                // certainly not 0
  };
  Sign signOf(const ir::ExpressionPtr& expression) const;
  void dropUnread();

  // ---- LowerDownward.cpp
  // Of a touch in z: refused where it leads upward, an alarm before it where the values decide.
  bool leadsDownward(const Touch& touch, SourceRange range);
  // Of one `by` in x or y: an alarm before it where the values may leave no way.
  void hasWay(const Touch& touch, SourceRange range);
  bool isOfCaller(const ir::ExpressionPtr& expression) const;
  Sign signOfDifference(const ir::ExpressionPtr& a, const ir::ExpressionPtr& b) const;
  void resolveGuard(std::vector<ir::CycleStatement>& list, std::size_t at, const ir::ExpressionPtr& here,
                    const std::function<void()>& unknown);

  // ---- LowerCoordinates.cpp
  // Axes whose coordinates a `set` on some path to the statement may have moved.
  std::vector<std::array<bool, 3>> shiftedBefore(const std::vector<ir::CycleStatement>& list) const;
  // Warns where a coordinate from before a `set` meets one from after it.
  void warnMixed();
  void warnDeviations(); // set as coordinates, or as lengths of tools

  const File& file_;
  const SourceMap& sources_;
  Diagnostics& diagnostics_;
  ir::Cycle cycle_;
  std::vector<ir::CycleStatement>* out_ = nullptr; // the checks or the body
  Scope scope_;
  Probe probe_ = Probe::Off;
  bool failed_ = false;
  std::set<std::string, std::less<>> taken_;  // names of variables
  std::map<std::string, int> numbers_;        // the next `_N` of a name that is taken
  std::set<ir::VariableId> touched_;          // of touches: dropped where nothing reads them
  std::map<ir::VariableId, ir::Axis> places_; // variables that get the place of the probe
  std::map<ir::VariableId, Sign> signs_;      // of parameters, by their checks
  std::map<std::string, ir::VariableId, std::less<>> hosts_;
  std::map<ir::VariableId, ir::AxisPosition> began_; // where the called cycles began
  std::map<ir::VariableId, ir::VariableId> same_;    // of starts_: the host input that has the same value
  std::set<ir::VariableId> starts_;                  // of places_: where a called cycle began
  std::set<ir::VariableId> placesOnly_; // of starts_: a place on the machine, whose coordinates are not known
  std::map<ir::VariableId, char> letters_;
  Results results_;
  Results known_; // those that have a value on each path to the statement
  std::vector<ir::ConditionPtr> demanded_;
  std::set<ir::LabelId> ways_; // after the checks that a touch has a way, for which locals are to be known
  std::set<ir::VariableId> guards_; // of places_: from there a touch in z is to lead downward
  std::map<ir::VariableId, ir::ExpressionPtr>
      lasting_; // locals that are assigned once, of what the caller gives
  std::uint32_t startMoves_ = 0;
  struct Site { // a call in the file itself
    SourceRange range;
    std::string called;
  };
  std::vector<Site> sites_;
  std::uint32_t site_ = 0; // the call that the statement is from, from 1; 0: it is the file's own
  std::size_t nested_ = 0; // branches and loops around the statement
  std::size_t depth_ = 0;  // of calls
  Programs* programs_ = nullptr;
  std::uint32_t levels_ = 0;
  const std::map<const File*, MacroCycle>* macros_ = nullptr;
  std::size_t macroCalls_ = 0;
  bool called_ = false; // it is a program that another one calls
  std::vector<Outline> outlines_;
  static constexpr std::size_t kMostStatements = 20000, kMostCalls = 50;
};

} // namespace dotek::frontend::cycle
