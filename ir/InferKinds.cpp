#include "ir/InferKinds.h"

#include "ir/Kinds.h"
#include "ir/Walk.h"

#include <deque>
#include <utility>

namespace dotek::ir {
namespace {

// Variables that are of one kind because they are added, compared or assigned.
struct Group {
  std::vector<VariableId> variables;
  Kind kind = Kind::Number;
};

bool hasRequirements(const CycleStatement& statement) {
  return std::holds_alternative<Move>(statement.node) || std::holds_alternative<Measure>(statement.node) ||
         std::holds_alternative<SetMode>(statement.node);
}

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
    while (!open_.empty()) {
      const std::size_t at = open_.front();
      open_.pop_front();
      spread(groups_[at]);
    }
  }

private:
  // A work variable that is set in several places may hold a length here and a number there: it stays a
  // number.
  bool holdsOneKind(VariableId id) const {
    return id >= assigned_.size() || assigned_[id] < 2 || cycle_.variables[id].role != Role::Local;
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

  void spread(const Group& group) {
    for (const VariableId id : group.variables) {
      if (id >= cycle_.variables.size() || cycle_.variables[id].kind != Kind::Number) continue;
      cycle_.variables[id].kind = group.kind;
      for (const std::size_t other : groupsOf_[id]) {
        if (groups_[other].kind != Kind::Number) continue;
        groups_[other].kind = group.kind;
        open_.push_back(other);
      }
    }
  }

  void read(const CycleStatement& statement) {
    if (const auto* set = std::get_if<Assign>(&statement.node)) {
      Group group;
      if (holdsOneKind(set->variable)) group.variables.push_back(set->variable);
      collect(set->value, group);
      groups_.push_back(std::move(group));
    } else if (const auto* branch = std::get_if<Branch>(&statement.node)) {
      read(branch->condition);
    } else if (!hasRequirements(statement)) {
      eachSlot(statement, [&](const ExpressionPtr& value) { add(value, Kind::Number); });
    } else {
      eachRequirement(statement, [&](const ExpressionPtr& value, Kind kind) { add(value, kind); });
    }
  }

  void read(const ConditionPtr& condition) {
    if (const auto* comparison = std::get_if<Comparison>(&condition->node)) {
      Group group;
      collect(comparison->left, group);
      collect(comparison->right, group);
      groups_.push_back(std::move(group));
    } else if (const auto* null = std::get_if<IsNull>(&condition->node)) {
      add(null->value, Kind::Number);
    } else if (const auto* negated = std::get_if<Not>(&condition->node)) {
      read(negated->inner);
    } else if (const auto* junction = std::get_if<Junction>(&condition->node)) {
      read(junction->left);
      read(junction->right);
    }
  }

  void add(const ExpressionPtr& value, Kind kind) {
    Group group;
    group.kind = kind;
    collect(value, group);
    if (!group.variables.empty()) groups_.push_back(std::move(group));
  }

  // Puts the variables that are of the kind of the whole into `group`; the others form groups of their own.
  void collect(const ExpressionPtr& expression, Group& group) {
    if (const auto* use = std::get_if<VariableUse>(&expression->node)) {
      if (holdsOneKind(use->variable)) group.variables.push_back(use->variable);
    } else if (const auto* machine = std::get_if<MachineVariable>(&expression->node)) {
      add(machine->number, Kind::Number);
    } else if (const auto* one = std::get_if<Unary>(&expression->node)) {
      if (keepsKind(one->op)) return collect(one->operand, group);
      add(one->operand, operandKind(one->op));
      if (group.kind == Kind::Number) group.kind = resultKind(one->op);
    } else if (const auto* two = std::get_if<Binary>(&expression->node)) {
      collectBinary(*two, group);
    }
  }

  void collectBinary(const Binary& node, Group& group) {
    if (addsKinds(node.op)) {
      collect(node.left, group);
      collect(node.right, group);
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
