#include "ir/ShareVariables.h"

#include "ir/Flow.h"
#include "ir/Rewrite.h"
#include "ir/Walk.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <vector>

namespace dotek::ir {
namespace {

using Ids = std::vector<bool>; // by variable

template <class Visit> void eachRead(const CycleStatement& statement, const Visit& visit) {
  eachNode(statement, [&](const Expression& node) {
    if (const auto* use = std::get_if<VariableUse>(&node.node)) visit(use->variable);
  });
}

// true: `into` has grown.
bool unite(Ids& into, const Ids& other) {
  bool grown = false;
  for (std::size_t id = 0; id < into.size(); ++id) {
    grown = grown || (other[id] && !into[id]);
    into[id] = into[id] || other[id];
  }
  return grown;
}

// Variables that some path reads after each statement, before it assigns them.
std::vector<Ids> liveAfter(const std::vector<CycleStatement>& list, std::size_t variables) {
  const auto next = successors(list);
  std::vector<Ids> before(list.size() + 1, Ids(variables)), after(list.size(), Ids(variables));
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = list.size(); i-- > 0;) {
      for (const std::size_t to : next[i])
        unite(after[i], before[to]);
      Ids now = after[i];
      if (const auto* assign = std::get_if<Assign>(&list[i].node)) now[assign->variable] = false;
      eachRead(list[i], [&](VariableId id) { now[id] = true; });
      changed |= unite(before[i], now);
    }
  }
  return after;
}

} // namespace

void shareVariables(Cycle& cycle) {
  const std::size_t count = cycle.variables.size();
  const std::vector<Ids> after = liveAfter(cycle.body, count);
  Ids mayShare(count), assigned(count);
  std::vector<VariableId> order; // of their first assignments
  for (const CycleStatement& statement : cycle.body)
    if (const auto* assign = std::get_if<Assign>(&statement.node);
        assign != nullptr && !assigned[assign->variable]) {
      assigned[assign->variable] = true;
      order.push_back(assign->variable);
    }
  for (VariableId id = 0; id < count; ++id)
    mayShare[id] = assigned[id] && cycle.variable(id).role == Role::Local && !cycle.variable(id).optional;
  for (const CycleStatement& statement : cycle.checks) {
    eachRead(statement, [&](VariableId id) { mayShare[id] = false; });
    if (const auto* assign = std::get_if<Assign>(&statement.node)) mayShare[assign->variable] = false;
  }
  // What is needed before the first statement was not assigned by this body.
  if (!cycle.body.empty()) {
    Ids first = after.front();
    if (const auto* assign = std::get_if<Assign>(&cycle.body.front().node)) first[assign->variable] = false;
    eachRead(cycle.body.front(), [&](VariableId id) { first[id] = true; });
    for (VariableId id = 0; id < count; ++id)
      if (first[id]) mayShare[id] = false;
  }
  std::vector<Ids> together(count, Ids(count)); // needed at the same time
  for (std::size_t i = 0; i < cycle.body.size(); ++i) {
    const auto* assign = std::get_if<Assign>(&cycle.body[i].node);
    if (assign == nullptr) continue;
    for (VariableId id = 0; id < count; ++id)
      if (after[i][id] && id != assign->variable)
        together[assign->variable][id] = together[id][assign->variable] = true;
  }
  std::vector<std::vector<VariableId>> shared; // the first gives the name
  std::map<VariableId, VariableId> names;
  for (const VariableId id : order) {
    if (!mayShare[id]) continue;
    const auto fits = [&](const std::vector<VariableId>& one) {
      return cycle.variable(one.front()).kind == cycle.variable(id).kind &&
             std::none_of(one.begin(), one.end(), [&](VariableId other) { return together[id][other]; });
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
  // A copy between two that became one.
  std::erase_if(cycle.body, [](const CycleStatement& statement) {
    const auto* assign = std::get_if<Assign>(&statement.node);
    const auto* use = assign != nullptr ? std::get_if<VariableUse>(&assign->value->node) : nullptr;
    return use != nullptr && use->variable == assign->variable;
  });
}

} // namespace dotek::ir
