// Work offsets that the checks count anew, 1 for G54 of a field that holds 54.
#include "backends/cycle/State.h"
#include "ir/Linear.h"
#include "ir/Match.h"
#include "ir/Rewrite.h"

#include <map>
#include <vector>

namespace dotek::backends::cycle {

namespace {

bool setsSystems(const ir::CycleStatement& statement) {
  return ir::match(
      statement, [](const ir::OneOf<ir::Measure, ir::CallCycle> auto&) { return true; },
      [](const ir::OneOf<ir::Move, ir::Label, ir::Jump, ir::Branch, ir::Store, ir::ProbePower, ir::Comment,
                         ir::Assign, ir::Return, ir::Spindle, ir::Coolant, ir::SetMode, ir::Dwell, ir::Stop,
                         ir::Alarm, ir::OpaqueBlock, ir::Port, ir::Print> auto&) { return false; });
}

} // namespace

void nameSystems(State& state, const Checked& checked) {
  std::map<ir::VariableId, ir::ExpressionPtr> counted;
  std::vector<ir::ExpressionPtr> given; // parameters that hold a system
  for (ir::VariableId id = 0; id < state.cycle.variables.size(); ++id) {
    const ir::Variable& variable = state.cycle.variable(id);
    if (variable.kind != ir::Kind::WorkOffset) continue;
    if (variable.role == ir::Role::Parameter) given.push_back(ir::variable(id));
    if (const auto at = checked.locals.find(id); at != checked.locals.end()) counted.insert(*at);
  }
  if (counted.empty()) return;
  const auto named = [&](const ir::ExpressionPtr& node) -> ir::ExpressionPtr {
    const auto* use = std::get_if<ir::VariableUse>(&node->node);
    const auto at = use == nullptr ? counted.end() : counted.find(use->variable);
    const ir::ExpressionPtr& value = at == counted.end() ? node : at->second;
    for (const ir::ExpressionPtr& parameter : given)
      if (ir::provenEqual(value, parameter, state.cycle)) return parameter;
    return value;
  };
  for (ir::CycleStatement& statement : state.cycle.body)
    if (setsSystems(statement)) ir::rewrite(statement, named);
  for (const auto& [id, value] : counted)
    state.shifts.erase(id);
}

} // namespace dotek::backends::cycle
