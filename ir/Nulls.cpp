#include "ir/Nulls.h"

#include "ir/Dataflow.h"

#include <utility>

namespace dotek::ir {
namespace {

using Set = NumberSet;

// Variables times statements that are followed path by path; beyond, what may be null once may be so always.
constexpr std::size_t kMostWork = 4'000'000;
// Length of a chain of copies that is looked at beyond that.
constexpr int kMostRounds = 50;

Set behind(const std::vector<CycleStatement>& list, std::size_t from, std::size_t to, Set nulls) {
  match(
      list[from],
      [&](const Assign& node) {
        if (mayBeNull(node.value, nulls))
          nulls.insert(node.variable);
        else
          nulls.erase(node.variable);
      },
      [&](const Branch& node) {
        bool negated = false;
        const auto* use = nullTest(node.condition, negated);
        if (!use) return;
        // A target right after the branch: both paths lead there.
        const auto* label = from + 1 < list.size() ? std::get_if<Label>(&list[from + 1].node) : nullptr;
        if (label && label->label == node.target) return;
        const bool taken = to != from + 1;
        if (taken == negated) nulls.erase(use->variable);
      },
      [](const OneOf<Store, Label, Jump, Return, Move, Measure, CallCycle, ProbePower, Spindle, Coolant,
                     SetMode, Dwell, Stop, Alarm, Comment, OpaqueBlock, Port, Print> auto&) {});
  return nulls;
}

// What may be null somewhere, from what may be so at the beginning.
Set anywhere(const Cycle& cycle, Set nulls) {
  bool changed = true;
  for (int round = 0; round < kMostRounds && changed; ++round) {
    changed = false;
    for (const auto* list : {&cycle.checks, &cycle.body}) {
      for (const CycleStatement& statement : *list) {
        const auto* set = std::get_if<Assign>(&statement.node);
        if (!set || nulls.contains(set->variable) || !mayBeNull(set->value, nulls)) continue;
        nulls.insert(set->variable);
        changed = true;
      }
    }
  }
  return nulls;
}

// Gives what may be null at the end of the list.
Set follow(const std::vector<CycleStatement>& list, Set entry, std::vector<Set>& out) {
  // One statement more: the end.
  std::vector<CycleStatement> extended = list;
  extended.push_back({Return{}, {}});
  auto facts = factsBefore(
      extended, std::move(entry),
      [&](std::size_t from, std::size_t to, const Set& nulls) { return behind(extended, from, to, nulls); },
      [](Set& into, const Set& other) { return into.unite(other); });
  for (std::size_t i = 0; i < list.size(); ++i)
    out.push_back(facts[i] ? std::move(*facts[i]) : Set{});
  return facts.back() ? std::move(*facts.back()) : Set{};
}

} // namespace

const VariableUse* nullTest(const ConditionPtr& condition, bool& negated) {
  const auto* inner = &condition;
  negated = false;
  if (const auto* node = std::get_if<Not>(&condition->node)) {
    inner = &node->inner;
    negated = true;
  }
  const auto* null = std::get_if<IsNull>(&(*inner)->node);
  return null ? std::get_if<VariableUse>(&null->value->node) : nullptr;
}

bool mayBeNull(const ExpressionPtr& expression, const Set& variables) {
  if (std::holds_alternative<NullValue>(expression->node)) return true;
  if (const auto* use = std::get_if<VariableUse>(&expression->node)) return variables.contains(use->variable);
  const auto* node = std::get_if<Binary>(&expression->node);
  return node && node->op == BinaryOp::ValueOr && mayBeNull(node->left, variables) &&
         mayBeNull(node->right, variables);
}

Nulls findNulls(const Cycle& cycle) {
  Set entry;
  for (VariableId id = 0; id < cycle.variables.size(); ++id) {
    const Variable& variable = cycle.variables[id];
    if (variable.role == Role::Parameter && variable.optional && !variable.defaultValue) entry.insert(id);
  }
  const std::size_t statements = cycle.checks.size() + cycle.body.size();
  Nulls out;
  const Set all = anywhere(cycle, entry);
  std::size_t size = 0;
  all.each([&](VariableId) { ++size; });
  if (all.empty() || size * statements > kMostWork) {
    out.checks.assign(cycle.checks.size(), all);
    out.body.assign(cycle.body.size(), all);
    return out;
  }
  Set between = follow(cycle.checks, std::move(entry), out.checks);
  follow(cycle.body, std::move(between), out.body);
  return out;
}

} // namespace dotek::ir
