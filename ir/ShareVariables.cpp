#include "ir/ShareVariables.h"

#include "ir/Flow.h"
#include "ir/IdBits.h"
#include "ir/Rewrite.h"
#include "ir/Walk.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <vector>

namespace dotek::ir {
namespace {

template <class Visit> void eachRead(const CycleStatement& statement, const Visit& visit) {
  eachNode(statement, [&](const Expression& node) {
    if (const auto* use = std::get_if<VariableUse>(&node.node)) visit(use->variable);
  });
}

// Variables that some path reads after each statement, before it assigns them.
std::vector<IdBits> liveAfter(const std::vector<CycleStatement>& list, std::size_t variables) {
  const auto next = successors(list);
  std::vector<IdBits> before(list.size() + 1, IdBits(variables)), after(list.size(), IdBits(variables));
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = list.size(); i-- > 0;) {
      for (const std::size_t to : next[i])
        after[i].unite(before[to]);
      IdBits now = after[i];
      if (const auto* assign = std::get_if<Assign>(&list[i].node)) now.erase(assign->variable);
      eachRead(list[i], [&](VariableId id) { now.insert(id); });
      changed |= before[i].unite(now);
    }
  }
  return after;
}

bool isMeasure(Kind kind) {
  return kind == Kind::Length || kind == Kind::Angle || kind == Kind::Number || kind == Kind::Ratio ||
         kind == Kind::Flag;
}

IdBits readIn(const std::vector<CycleStatement>& list, std::size_t variables) {
  IdBits out(variables);
  for (const CycleStatement& statement : list)
    eachRead(statement, [&](VariableId id) { out.insert(id); });
  return out;
}

// Locals that are assigned once, a variable that is never assigned, are that variable.
void dropCopies(Cycle& cycle) {
  std::vector<std::size_t> assigned(cycle.variables.size());
  for (const auto* list : {&cycle.checks, &cycle.body})
    for (const CycleStatement& statement : *list)
      if (const auto* assign = std::get_if<Assign>(&statement.node)) ++assigned[assign->variable];
  const IdBits inChecks = readIn(cycle.checks, cycle.variables.size());
  std::map<VariableId, VariableId> names;
  for (const CycleStatement& statement : cycle.body) {
    const auto* assign = std::get_if<Assign>(&statement.node);
    const auto* use = assign != nullptr ? std::get_if<VariableUse>(&assign->value->node) : nullptr;
    if (use == nullptr || assigned[assign->variable] != 1 || inChecks.contains(assign->variable) ||
        cycle.variable(assign->variable).role != Role::Local)
      continue;
    const auto named = names.find(use->variable);
    const VariableId original = named == names.end() ? use->variable : named->second;
    if (assigned[original] == 0) names.emplace(assign->variable, original);
  }
  rename(cycle.body, names);
}

// It has a value whatever the operands are.
bool alwaysHasValue(const ExpressionPtr& value) {
  bool out = true;
  eachNode(value, [&](const Expression& node) {
    if (const auto* one = std::get_if<Unary>(&node.node))
      out = out && (one->op == UnaryOp::Negate || one->op == UnaryOp::Absolute);
    if (const auto* both = std::get_if<Binary>(&node.node))
      out = out &&
            (both->op == BinaryOp::Add || both->op == BinaryOp::Subtract || both->op == BinaryOp::Multiply);
    out = out && !std::holds_alternative<MachineVariable>(node.node);
  });
  return out;
}

// Results that nobody asked for, such as the smallest of some, with the branches that choose them.
void dropUnneeded(Cycle& cycle) {
  std::vector<CycleStatement>& body = cycle.body;
  std::map<LabelId, std::size_t> labels;
  for (std::size_t i = 0; i < body.size(); ++i)
    if (const auto* label = std::get_if<Label>(&body[i].node)) labels.emplace(label->label, i);
  IdBits needed = readIn(cycle.checks, cycle.variables.size());
  for (VariableId id = 0; id < cycle.variables.size(); ++id)
    if (cycle.variable(id).role != Role::Local) needed.insert(id);
  const auto isNeeded = [&](std::size_t i) {
    if (const auto* assign = std::get_if<Assign>(&body[i].node))
      return needed.contains(assign->variable) || !alwaysHasValue(assign->value);
    const auto* branch = std::get_if<Branch>(&body[i].node);
    return branch == nullptr || labels.at(branch->target) < i;
  };
  // A branch forward, past what nothing needs.
  const auto decidesNothing = [&](std::size_t i, const std::vector<bool>& stays) {
    const auto* branch = std::get_if<Branch>(&body[i].node);
    if (branch == nullptr || labels.at(branch->target) < i) return false;
    for (std::size_t k = i + 1; k < labels.at(branch->target); ++k)
      if (stays[k] && !std::holds_alternative<Label>(body[k].node)) return false;
    return true;
  };
  std::vector<bool> stays(body.size());
  for (bool grown = true; grown;) {
    grown = false;
    for (std::size_t i = body.size(); i-- > 0;) {
      if (stays[i] ||
          (!isNeeded(i) && (!std::holds_alternative<Branch>(body[i].node) || decidesNothing(i, stays))))
        continue;
      stays[i] = grown = true;
      eachRead(body[i], [&](VariableId id) { needed.insert(id); });
    }
  }
  std::vector<CycleStatement> rest;
  for (std::size_t i = 0; i < body.size(); ++i)
    if (stays[i]) rest.push_back(std::move(body[i]));
  body = std::move(rest);
}

// A copy between two that became one.
void dropSelfCopies(std::vector<CycleStatement>& body) {
  std::erase_if(body, [](const CycleStatement& statement) {
    const auto* assign = std::get_if<Assign>(&statement.node);
    const auto* use = assign != nullptr ? std::get_if<VariableUse>(&assign->value->node) : nullptr;
    return use != nullptr && use->variable == assign->variable;
  });
}

} // namespace

void shareVariables(Cycle& cycle, Sharing sharing) {
  const bool arguments = sharing == Sharing::Arguments;
  if (arguments) {
    dropUnneeded(cycle);
    dropCopies(cycle);
    dropSelfCopies(cycle.body);
  }
  const std::size_t count = cycle.variables.size();
  const std::vector<IdBits> after = liveAfter(cycle.body, count);
  IdBits mayShare(count), assigned(count);
  std::vector<VariableId> order; // of their first assignments
  for (const CycleStatement& statement : cycle.body)
    if (const auto* assign = std::get_if<Assign>(&statement.node);
        assign != nullptr && !assigned.contains(assign->variable)) {
      assigned.insert(assign->variable);
      order.push_back(assign->variable);
    }
  for (VariableId id = 0; id < count; ++id)
    if (assigned.contains(id) && cycle.variable(id).role == Role::Local && !cycle.variable(id).optional)
      mayShare.insert(id);
  for (const CycleStatement& statement : cycle.checks) {
    eachRead(statement, [&](VariableId id) { mayShare.erase(id); });
    if (const auto* assign = std::get_if<Assign>(&statement.node)) mayShare.erase(assign->variable);
  }
  // What is needed before the first statement was not assigned by this body.
  if (!cycle.body.empty()) {
    IdBits first = after.front();
    if (const auto* assign = std::get_if<Assign>(&cycle.body.front().node)) first.erase(assign->variable);
    eachRead(cycle.body.front(), [&](VariableId id) { first.insert(id); });
    for (VariableId id = 0; id < count; ++id)
      if (first.contains(id)) mayShare.erase(id);
  }
  std::vector<IdBits> together(count, IdBits(count)); // needed at the same time
  for (std::size_t i = 0; i < cycle.body.size(); ++i) {
    const auto* assign = std::get_if<Assign>(&cycle.body[i].node);
    if (assign == nullptr) continue;
    for (VariableId id = 0; id < count; ++id)
      if (after[i].contains(id) && id != assign->variable) {
        together[assign->variable].insert(id);
        together[id].insert(assign->variable);
      }
  }
  std::vector<std::vector<VariableId>> shared; // the first gives the name
  std::map<VariableId, VariableId> names;
  if (arguments) {
    // One that nothing reads is no argument.
    const IdBits inChecks = readIn(cycle.checks, count), inBody = readIn(cycle.body, count);
    for (VariableId id = 0; id < count; ++id)
      if (cycle.variable(id).role == Role::Parameter && !assigned.contains(id) &&
          (inChecks.contains(id) || inBody.contains(id)))
        shared.push_back({id});
  }
  for (const VariableId id : order) {
    if (!mayShare.contains(id)) continue;
    const auto fits = [&](const std::vector<VariableId>& one) {
      const Kind own = cycle.variable(id).kind, other = cycle.variable(one.front()).kind;
      return (own == other || (arguments && isMeasure(own) && isMeasure(other))) &&
             std::none_of(one.begin(), one.end(),
                          [&](VariableId each) { return together[id].contains(each); });
    };
    const auto found = std::find_if(shared.begin(), shared.end(), fits);
    if (found == shared.end()) {
      shared.push_back({id});
      continue;
    }
    names.emplace(id, found->front());
    found->push_back(id);
  }
  rename(cycle.body, names);
  dropSelfCopies(cycle.body);
}

} // namespace dotek::ir
