// Arguments that must not be omitted, and that nothing but checks reads: asked for where a check reads them.
#include "backends/fanuc/State.h"
#include "backends/fanuc/Uses.h"
#include "ir/Flow.h"

#include <algorithm>

namespace dotek::backends::fanuc {

namespace {

using Ids = std::set<ir::VariableId>;

void keepCommon(Ids& ids, const Ids& others) {
  std::erase_if(ids, [&](ir::VariableId id) { return !others.contains(id); });
}

// Of a junction the right side may not be reached.
Ids readFirst(const ir::ConditionPtr& condition) {
  if (const auto* junction = std::get_if<ir::Junction>(&condition->node)) return readFirst(junction->left);
  if (const auto* inverse = std::get_if<ir::Not>(&condition->node)) return readFirst(inverse->inner);
  return variablesOf(condition);
}

Ids readBy(const ir::CycleStatement& statement) {
  if (const auto* branch = std::get_if<ir::Branch>(&statement.node)) return readFirst(branch->condition);
  if (const auto* assign = std::get_if<ir::Assign>(&statement.node)) return variablesOf(assign->value);
  return {};
}

} // namespace

void planDemands(State& state) {
  const std::vector<ir::CycleStatement>& checks = state.cycle.checks;
  const Ids body = bodyVariables(state.cycle);
  Ids wanted;
  for (const Argument& argument : state.arguments)
    if (!mayBeOmitted(state, argument.variable) && !body.contains(argument.variable))
      wanted.insert(argument.variable);
  if (wanted.empty()) return;

  // What every way to a statement has read; the end comes last.
  const auto next = ir::successors(checks);
  std::vector<std::optional<Ids>> before(checks.size() + 1);
  before[0] = Ids{};
  std::vector<std::size_t> open = {0};
  while (!open.empty()) {
    const std::size_t at = open.back();
    open.pop_back();
    if (at >= checks.size()) continue;
    Ids after = *before[at];
    after.merge(readBy(checks[at]));
    for (const std::size_t then : next[at]) {
      Ids known = before[then] ? *before[then] : after;
      keepCommon(known, after);
      if (before[then] == known) continue;
      before[then] = std::move(known);
      open.push_back(then);
    }
  }
  const std::optional<Ids>& end = before.back();
  for (const ir::VariableId id : wanted)
    if (end && !end->contains(id)) state.late.insert(id);
  if (state.late.empty()) return;
  for (std::optional<Ids>& ids : before) {
    Ids missing = state.late;
    if (ids) std::erase_if(missing, [&](ir::VariableId id) { return ids->contains(id); });
    state.notAsked.push_back(std::move(missing));
  }
}

void demand(State& state, const Ids& ids, const ir::Origin& origin) {
  for (const Argument& argument : state.arguments)
    if (ids.contains(argument.variable) && state.toAsk.erase(argument.variable) > 0)
      alarmIf(state, ir::isNull(ir::variable(argument.variable)),
              std::string("ARGUMENT ") + argument.letter + " MISSING", origin);
}

bool demandsWithin(const State& state, const ir::ConditionPtr& condition) {
  if (state.toAsk.empty()) return false;
  const Ids read = variablesOf(condition);
  return std::any_of(read.begin(), read.end(), [&](ir::VariableId id) { return state.toAsk.contains(id); });
}

} // namespace dotek::backends::fanuc
