#include "targets/Reports.h"

#include "ir/CycleNames.h"
#include "ir/Fold.h"
#include "ir/Walk.h"

#include <set>
#include <utility>
#include <variant>
#include <vector>

namespace dotek::targets {

namespace {

std::set<ir::VariableId> readInBody(const ir::Cycle& cycle) {
  std::set<ir::VariableId> out;
  for (const ir::CycleStatement& statement : cycle.body)
    ir::eachNode(statement, [&](const ir::Expression& node) {
      if (const auto* use = std::get_if<ir::VariableUse>(&node.node)) out.insert(use->variable);
    });
  return out;
}

} // namespace

std::optional<SourceRange> dropReports(project::LoweredCycle& lowered) {
  if (!lowered.programs.empty()) return std::nullopt;
  ir::Cycle& cycle = lowered.cycle;
  const std::set<ir::VariableId> before = readInBody(cycle);
  std::optional<SourceRange> first;
  std::vector<ir::CycleStatement> body;
  for (ir::CycleStatement& statement : cycle.body) {
    const auto* call = std::get_if<ir::CallCycle>(&statement.node);
    if (call == nullptr || call->cycle != ir::kReport) {
      body.push_back(std::move(statement));
      continue;
    }
    if (!body.empty() && std::holds_alternative<ir::Comment>(body.back().node)) body.pop_back();
    if (!first) first = statement.origin.range();
  }
  cycle.body = std::move(body);
  if (!first) return std::nullopt;
  ir::fold(cycle, {});
  const std::set<ir::VariableId> after = readInBody(cycle);
  for (const ir::VariableId id : before) {
    const ir::Variable& variable = cycle.variable(id);
    if (variable.role == ir::Role::Parameter && variable.defaultValue && !after.contains(id))
      lowered.fixed.emplace(id, *variable.defaultValue);
  }
  return first;
}

} // namespace dotek::targets
