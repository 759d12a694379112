#include "backends/fanuc/OwnCycles.h"

#include "ir/CycleNames.h"
#include "support/messages/Cycle.h"

#include <algorithm>

namespace dotek::backends::fanuc {
namespace {

bool has(const ir::CallCycle& cycle, std::string_view parameter) {
  return std::any_of(cycle.arguments.begin(), cycle.arguments.end(),
                     [&](const ir::CycleArgument& one) { return one.parameter == parameter; });
}

void leaveReportOut(State& state, const ir::Origin& origin) {
  if (!state.reported.insert("report").second) return;
  state.diagnostics.report<diag::ReportLeftOut>(origin.range(), state.control.title);
  state.remarks.push_back("REPORTS OF THE SOURCE ARE NOT PRINTED");
}

} // namespace

bool writeOwnCycle(State& state, const ir::CallCycle& cycle, const ir::Origin& origin) {
  const SourceRange range = origin.range();
  const auto refuse = [&](const char* what, const char* remedy) {
    state.refuse<diag::CycleStatementCannot>(range, what, state.control.title, state.macros.title, remedy);
    return true;
  };
  if (cycle.cycle == ir::kSetOffset) {
    writeSetOffset(state, cycle, origin);
    return true;
  }
  if (cycle.cycle == ir::kSetTool)
    return refuse("a correction of a tool", "report the value, and correct the tool on the machine");
  if (cycle.cycle == ir::kKeep)
    return refuse("a value for a later run", "report the value, or decide on it in this cycle");
  if (cycle.cycle == ir::kSurfaceAlong) return refuse("a touch along a direction", "touch along x, y or z");
  if (cycle.cycle == ir::kReport) {
    leaveReportOut(state, origin);
    return true;
  }
  if (cycle.cycle == ir::kResults) return true; // taken out before
  if (cycle.cycle != ir::kSurface) return false;
  if (has(cycle, "once")) return refuse("a single touch", "leave `once` out: the macros touch as they do");
  if (has(cycle, "miss"))
    return refuse("going on where nothing is found", "leave the `else` out: the macro stops with an alarm");
  return false;
}

} // namespace dotek::backends::fanuc
