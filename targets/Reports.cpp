#include "targets/Reports.h"

#include "ir/CycleNames.h"
#include "ir/Fold.h"

#include <utility>
#include <variant>
#include <vector>

namespace dotek::targets {

std::optional<SourceRange> dropReports(ir::Cycle& cycle) {
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
  if (first) ir::fold(cycle, {});
  return first;
}

} // namespace dotek::targets
