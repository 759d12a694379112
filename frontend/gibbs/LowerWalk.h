// Ways through flat code with symbolic values: what can be reached, how it ends after each message, what a
// way knows where a move begins. Everything that is not proved impossible is taken as possible.
#pragma once

#include "frontend/gibbs/LowerAsked.h"
#include "frontend/gibbs/LowerCases.h"
#include "frontend/gibbs/LowerFlat.h"
#include "frontend/gibbs/LowerWays.h"
#include "frontend/gibbs/Program.h"
#include "frontend/gibbs/Value.h"
#include "ir/Arithmetic.h"
#include "support/Limits.h"

#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace dotek::frontend::gibbs {

// What a path has learnt of one quantity, by conditions that it has passed.
struct Fact {
  Range range;
  std::vector<std::pair<Relation, double>> learnt; // ascending
  std::vector<std::uint32_t> numbers;              // of what is learnt up to each of these, in keys
  std::set<Symbol> symbols;
  // The part of the range that matters to later conditions, where no more is kept (AskedBounds).
  bool reduced = false;
  std::vector<std::uint32_t> parts;
};
using Facts = std::map<std::string, Fact>;

// A move along one axis whose follower is not judged yet.
struct Leg {
  std::size_t step = 0;
  ir::Axis axis = ir::Axis::X;
  std::optional<Value> begin; // nothing: not known
  Value target = 0.0;
  int sign = 0; // of the path to the contact, where the code shows a touch; else 0
  bool forced = false;
  bool exempt = false; // the first positioning, from wherever the cycle begins
};

// A move that turned, to a place where the path had not stood.
struct Turn {
  std::size_t run = 0; // first move of its run along one axis
  std::size_t step = 0;
  std::size_t place = 0; // number of the place; kNowhere: not known, or no later are clears it
  auto operator<=>(const Turn&) const = default;
};

// A move along several axes at once.
struct Out {
  std::size_t step = 0;
  std::array<std::optional<Value>, 3> begin;
};

// Where the probe is; X and Y from the entry, Z from the retract plane.
struct Track {
  std::array<std::optional<Value>, 3> at; // nothing: not known
  std::optional<Leg> before;              // `last` is its follower, along the same axis
  std::optional<Leg> last;
  std::optional<Out> out;      // the last move, where it goes along several axes
  std::size_t run = 0;         // step of the first move of the moves along one axis
  std::set<std::size_t> stood; // numbers of the places where it has stood
  std::set<Turn> turns;
};

struct WalkState {
  std::size_t at = 0;
  std::vector<std::optional<Value>> values; // of variables that steps change; nothing: not set
  Facts facts;
  Ways::Id way = 0;
  bool answered = false; // a question of the step at `at` has been answered; it is the same visit
  Track track;
};

class MoveObserver {
public:
  virtual ~MoveObserver() = default;
  // Before the move; sets the track. `target` as written, nothing where the axis is not.
  virtual void move(WalkState& state, std::size_t step,
                    const std::array<std::optional<Value>, 3>& target) = 0;
  virtual void end(WalkState& state) = 0;
};

struct WalkOptions {
  bool facts = true;  // learn from conditions
  bool forget = true; // drop what no later condition can ask for
  bool unsetZero = false;
  std::set<std::size_t> alarms;            // messages that nothing gets past
  std::map<ir::VariableId, double> values; // parameters and hosts that are known
  MoveObserver* observer = nullptr;
};

struct WalkResult {
  using Ends = PathEnds;
  bool complete = false; // false: too many paths
  std::vector<bool> reached;
  std::vector<bool> jumps, falls;                     // of branches: both answers are possible
  std::map<std::size_t, Ends> behind;                 // of messages: how the paths end
  std::map<std::size_t, Ends> ends;                   // of Return steps
  std::map<std::size_t, std::set<std::size_t>> codes; // steps that set the code a Return rejects with
  std::vector<Diagnostic> refusals;
  std::set<ir::VariableId> unset; // read before they are set
};

// What the code can change between two visits of `head`.
struct CycleChanges {
  std::set<ir::VariableId> variables;
  std::array<bool, 3> axes{};
};

// All circles of the code, found at once.
class Circles {
public:
  explicit Circles(const Flat& flat);

  // Nothing where the step is on no circle.
  const CycleChanges& around(std::size_t head) const { return changes_[of_[head]]; }

private:
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  void close(const Flat& flat, std::size_t head, std::vector<std::size_t>& found);

  std::vector<std::size_t> of_; // by step, an index of changes_
  std::vector<CycleChanges> changes_;
};

class Walk {
public:
  Walk(const Flat& flat, const ir::Cycle& cycle, const Limits& limits, WalkOptions options);
  WalkResult run();

private:
  struct Head {
    CycleChanges changes;
    std::vector<std::uint32_t> first; // values when it was first reached: changing variables, axes
    std::vector<bool> varies;         // since then
  };

  void start();
  void findAsked();
  void finish();
  void follow(WalkState state);
  // false: the path ends here.
  bool step(WalkState& state);
  bool step(WalkState& state, const FlatAssign& s);
  bool step(WalkState& state, const FlatBranch& s);
  bool step(WalkState& state, const FlatMove& s);
  bool step(WalkState& state, const FlatReturn& s);
  bool step(WalkState& state, const FlatJump& s);
  bool step(WalkState& state, const FlatEnd& s);
  bool step(WalkState&, const FlatRefuse& s);
  bool step(WalkState& state, const FlatMessage&);
  bool step(WalkState& state, const FlatDialog&);
  bool step(WalkState& state, const FlatUnset& s);
  void ended(const WalkState& state, bool rejects);
  std::optional<double> knownNumber(WalkState& state, ir::VariableId variable);
  bool isNew(WalkState& state);
  void forget(WalkState& state) const;
  bool reduce(const std::string& quantity, Fact& fact, std::size_t at) const;
  // Equal keys are states from which the path goes on in the same way.
  std::u32string keyOf(const WalkState& state);
  std::uint32_t numberOf(const std::optional<Value>& value);
  std::uint32_t numberOf(const std::string& bytes) {
    return numbers_.emplace(bytes, static_cast<std::uint32_t>(numbers_.size())).first->second;
  }
  // How later conditions tell the value of changing variable `slot` from others.
  std::uint32_t numberOf(const WalkState& state, std::size_t slot);
  void compareVisit(Head& head, const WalkState& state);
  void widen(WalkState& state, const Head& head);
  void computeLiveness();
  bool live(std::size_t at, ir::VariableId variable) const {
    return live_.empty() || (live_[at * liveWords_ + variable / 64] >> variable % 64 & 1) != 0;
  }
  std::optional<Value>& valueOf(WalkState& state, ir::VariableId variable) {
    return constant_[variable] ? constants_[variable] : state.values[slots_[variable]];
  }

  std::optional<Value> evaluate(WalkState& state, const ir::ExpressionPtr& e);
  std::optional<Value> evaluate(WalkState& state, const ir::Unary& node);
  std::optional<Value> evaluate(WalkState& state, const ir::Binary& node);
  std::optional<Value> read(WalkState& state, ir::VariableId variable, SourceRange range);
  Value opaque(const std::string& text, const std::vector<Value>& from);
  std::optional<bool> decide(WalkState& state, const ir::ConditionPtr& condition);
  std::optional<bool> decide(WalkState& state, const ir::Comparison& comparison);
  std::optional<bool> compare(const WalkState& state, const Value& left, Relation relation,
                              const Value& right);
  void learn(WalkState& state, const Question& question, Relation relation);

  const Flat& flat_;
  const ir::Cycle& cycle_;
  WalkOptions options_;
  std::size_t maxStates_, maxSteps_;
  std::size_t steps_ = 0;
  WalkResult result_;
  Ways ways_;
  std::vector<WalkState> waiting_;
  std::vector<bool> constant_;                  // variables that have a value and that no step changes
  std::vector<std::optional<Value>> constants_; // theirs
  std::vector<ir::VariableId> changing_;        // the others
  std::vector<std::size_t> slots_;              // of variables in `changing_`
  std::optional<Asked> asked_;                  // where nothing but the conditions sees a state
  Cases cases_;
  std::map<ir::VariableId, std::string> quantities_; // keys of what questions ask of a variable alone
  std::vector<bool> joins_;                          // steps that something jumps to
  std::vector<bool> heads_;                          // of these, from further down: every circle has one
  std::vector<std::unordered_map<std::u32string, Ways::Id>> seen_; // by place
  std::unordered_map<std::string, std::uint32_t> numbers_;         // of values and quantities, in keys
  std::string bytes_;                                              // room for what is looked up in `numbers_`
  std::size_t states_ = 0;
  std::map<std::size_t, Head> circles_; // by place
  std::optional<Circles> circlesOf_;    // of flat_, once a head is met
  std::vector<std::uint64_t> live_;     // a bit for each step and variable; empty: all
  std::size_t liveWords_ = 0;           // of a step
  std::map<std::string, std::size_t> interned_;
  std::optional<Question> question_;
  bool failed_ = false; // an evaluation found no value, and question_ does not say why
};

// Successors by place; Ends and Refuses have none.
std::vector<std::size_t> followers(const Flat& flat, std::size_t at);

bool provenAbove(const Facts& facts, const Value& value); // value > 0
bool provenBelow(const Facts& facts, const Value& value);
bool provenZero(const Facts& facts, const Value& value);
bool provenNotAbove(const Facts& facts, const Value& value); // value <= 0
bool provenNotBelow(const Facts& facts, const Value& value);
// Depends on what a loop has changed too often to be followed: one name for many values.
bool isWidened(const Value& value);

} // namespace dotek::frontend::gibbs
