#include "ir/InferKinds.h"

#include "ir/Kinds.h"
#include "ir/Walk.h"

#include <algorithm>
#include <deque>
#include <utility>

namespace dotek::ir {
namespace {

// Variables that are of one kind because they are added, compared or assigned.
struct Group {
  std::vector<VariableId> variables;
  Kind kind = Kind::Number;
  bool index = false; // chooses a variable of the machine: whole, unless something else is known of it
  // Of the variables those that are in a sum with a number which makes none of G54 to G59 of them: pallet +
  // 100.
  std::vector<VariableId> shifted;
};

class Inference {
public:
  explicit Inference(Cycle& cycle)
      : cycle_(cycle), groupsOf_(cycle.variables.size()), assigned_(cycle.variables.size()) {
    for (const auto* list : {&cycle.checks, &cycle.body})
      for (const CycleStatement& statement : *list) {
        const auto* set = std::get_if<Assign>(&statement.node);
        if (set != nullptr && set->variable < assigned_.size()) ++assigned_[set->variable];
      }
  }

  void run() {
    for (const auto* list : {&cycle_.checks, &cycle_.body})
      for (const CycleStatement& statement : *list)
        read(statement);
    for (std::size_t i = 0; i < groups_.size(); ++i)
      for (const VariableId id : groups_[i].variables)
        if (id < groupsOf_.size()) groupsOf_[id].push_back(i);
    // What is declared or required comes first, in the order of the source; then kinds spread.
    for (std::size_t i = 0; i < groups_.size(); ++i)
      if (groups_[i].kind != Kind::Number) open_.push_back(i);
    for (std::size_t i = 0; i < groups_.size(); ++i)
      if (groups_[i].kind == Kind::Number && adopt(groups_[i])) open_.push_back(i);
    spreadAll();
    for (std::size_t i = 0; i < groups_.size(); ++i) {
      if (!groups_[i].index || groups_[i].kind != Kind::Number || adopt(groups_[i])) continue;
      groups_[i].kind = Kind::Count;
      open_.push_back(i);
    }
    spreadAll();
  }

private:
  // A work variable that is set in several places may hold a length here and a number there: it stays a
  // number.
  bool holdsOneKind(VariableId id) const {
    return id >= assigned_.size() || assigned_[id] < 2 || cycle_.variables[id].role != Role::Local;
  }

  void spreadAll() {
    while (!open_.empty()) {
      const std::size_t at = open_.front();
      open_.pop_front();
      spread(groups_[at]);
    }
  }

  // The kind of the first declared variable of the group.
  bool adopt(Group& group) const {
    for (const VariableId id : group.variables) {
      if (id >= cycle_.variables.size() || cycle_.variables[id].kind == Kind::Number) continue;
      group.kind = cycle_.variables[id].kind;
      return true;
    }
    return false;
  }

  // A whole number that chooses a variable may turn out to be the offset that it belongs to.
  static bool isOpen(Kind now, Kind given) {
    return now == Kind::Number ||
           (now == Kind::Count && (given == Kind::WorkOffset || given == Kind::ToolOffset));
  }

  void spread(const Group& group) {
    for (const VariableId id : group.variables) {
      if (id >= cycle_.variables.size() || !isOpen(cycle_.variables[id].kind, group.kind)) continue;
      const bool counts = group.kind == Kind::WorkOffset &&
                          std::find(group.shifted.begin(), group.shifted.end(), id) != group.shifted.end();
      cycle_.variables[id].kind = counts ? Kind::Count : group.kind;
      if (counts) continue;
      for (const std::size_t other : groupsOf_[id]) {
        if (!isOpen(groups_[other].kind, group.kind)) continue;
        groups_[other].kind = group.kind;
        open_.push_back(other);
      }
    }
  }

  void read(const CycleStatement& statement) {
    match(
        statement,
        [&](const Assign& node) {
          Group group;
          if (holdsOneKind(node.variable)) group.variables.push_back(node.variable);
          collect(node.value, group);
          groups_.push_back(std::move(group));
        },
        [&](const Branch& node) { read(node.condition); },
        [&](const OneOf<Move, Measure, CallCycle, SetMode> auto&) {
          eachRequirement(statement, [&](const ExpressionPtr& value, Kind kind) { add(value, kind); });
        },
        [&](const OpaqueBlock& node) {
          for (const Word& word : node.words) {
            const bool ofTool = word.address == 'T' || word.address == 'H';
            if (word.value != nullptr) add(word.value, ofTool ? Kind::ToolOffset : Kind::Number);
          }
        },
        [&](const Store& node) {
          addIndex(node.number);
          add(node.value, Kind::Number);
        },
        [&](const OneOf<Label, Jump, Return, ProbePower, Spindle, Coolant, Dwell, Stop, Alarm, Comment, Port,
                        Print> auto&) {
          eachSlot(statement, [&](const ExpressionPtr& value) { add(value, Kind::Number); });
        });
  }

  void read(const ConditionPtr& condition) {
    match(
        *condition,
        [&](const Comparison& node) {
          Group group;
          collect(node.left, group);
          collect(node.right, group);
          groups_.push_back(std::move(group));
        },
        [&](const IsNull& node) { add(node.value, Kind::Number); },
        [&](const Not& node) { read(node.inner); },
        [&](const Junction& node) {
          read(node.left);
          read(node.right);
        },
        [](const Truth&) {});
  }

  void addIndex(const ExpressionPtr& number) {
    const std::size_t first = groups_.size();
    add(number, Kind::Number);
    if (groups_.size() > first) groups_.back().index = true;
  }

  void add(const ExpressionPtr& value, Kind kind) {
    Group group;
    group.kind = kind;
    collect(value, group);
    if (!group.variables.empty()) groups_.push_back(std::move(group));
  }

  // Puts the variables that are of the kind of the whole into `group`; the others form groups of their own.
  void collect(const ExpressionPtr& expression, Group& group) {
    match(
        *expression,
        [&](const VariableUse& node) {
          if (holdsOneKind(node.variable)) group.variables.push_back(node.variable);
        },
        [&](const MachineVariable& node) { addIndex(node.number); },
        [&](const Unary& node) {
          if (keepsKind(node.op)) return collect(node.operand, group);
          add(node.operand, operandKind(node.op));
          if (group.kind == Kind::Number) group.kind = resultKind(node.op);
        },
        [&](const Binary& node) { collectBinary(node, group); },
        [&](const MeasuredResult& node) {
          if (group.kind == Kind::Number) group.kind = resultKind(node.name);
        },
        [](const OneOf<Constant, NullValue> auto&) {});
  }

  void collectBinary(const Binary& node, Group& group) {
    if (addsKinds(node.op)) {
      const std::size_t first = group.variables.size();
      collect(node.left, group);
      collect(node.right, group);
      if (isShiftedCount(node))
        group.shifted.insert(group.shifted.end(),
                             group.variables.begin() + static_cast<std::ptrdiff_t>(first),
                             group.variables.end());
      return;
    }
    if (node.op == BinaryOp::Direction) {
      Group sides;
      collect(node.left, sides);
      collect(node.right, sides);
      groups_.push_back(std::move(sides));
      if (group.kind == Kind::Number) group.kind = Kind::Angle;
      return;
    }
    // A multiple by a constant is of the kind of what is multiplied.
    const bool product = node.op == BinaryOp::Multiply;
    if (constantValue(node.right) && (product || node.op == BinaryOp::Divide))
      return collect(node.left, group);
    if (constantValue(node.left) && product) return collect(node.right, group);
    add(node.left, Kind::Number);
    add(node.right, Kind::Number);
  }

  Cycle& cycle_;
  std::vector<Group> groups_;
  std::vector<std::vector<std::size_t>> groupsOf_;
  std::vector<std::size_t> assigned_; // number of assignments, by variable
  std::deque<std::size_t> open_;      // groups whose kind is to be given to their variables
};

} // namespace

void inferKinds(Cycle& cycle) {
  Inference(cycle).run();
}

} // namespace dotek::ir
