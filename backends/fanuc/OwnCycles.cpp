#include "backends/fanuc/OwnCycles.h"

#include "backends/common/MacroCall.h"
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
  if (const CalledProgram* const program = calledProgram(state, cycle)) {
    writeProgramCall(state, *program, cycle, origin);
    return true;
  }
  if (cycle.cycle == ir::kSetOffset) {
    writeSetOffset(state, cycle, origin);
    return true;
  }
  if (cycle.cycle == ir::kSetTool) {
    writeSetTool(state, cycle, origin);
    return true;
  }
  if (cycle.cycle == ir::kKeep) {
    const std::string remedy =
        "name a common variable that keeps it, as `--result " + cycle.arguments.front().parameter + "=#560`";
    return refuse("a value for a later run", remedy.c_str());
  }
  if (cycle.cycle == ir::kSurfaceAlong) {
    const bool plane = state.macros.find(stdlib::Intent::AngledSurface) == nullptr;
    return refuse(plane ? "a touch along a direction" : "a touch along a direction that leads up or down",
                  plane ? "touch along x, y or z, or take `--probe-macros dotek`"
                        : "touch along x, y or z, or along a direction of x and y");
  }
  if (cycle.cycle == ir::kReport) {
    leaveReportOut(state, origin);
    return true;
  }
  if (cycle.cycle == ir::kResults) return true; // taken out before
  const bool along = cycle.set.empty() && cycle.cycle == stdlib::intentName(stdlib::Intent::AngledSurface);
  if (cycle.cycle != ir::kSurface && !along) return false;
  if (has(cycle, "once")) return refuse("a single touch", "leave `once` out: the macros touch as they do");
  const stdlib::MacroSignature* const signature = signatureOf(state.macros, cycle);
  if (cycle.set.empty() && has(cycle, stdlib::roleName(stdlib::ArgumentRole::FlagOnly)) &&
      signature != nullptr && signature->find(stdlib::ArgumentRole::FlagOnly) == nullptr)
    return refuse("going on where nothing is found",
                  "leave the `else` out, and the macro stops with an alarm, or take `--probe-macros dotek`");
  if (along) guardDistance(state, cycle, origin);
  return false;
}

} // namespace dotek::backends::fanuc
