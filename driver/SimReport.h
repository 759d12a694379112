// Private to Sim.cpp: how a run ended, as diagnostics and as JSON.
#pragma once

#include "driver/Session.h"
#include "frontend/nc/Scan.h"
#include "sim/Machine.h"
#include "sim/Run.h"

#include <string>

namespace dotek::driver {

void reportScanError(const std::string& path, const frontend::nc::Scanner& scanner, const LineChunks& chunks,
                     Session& session);
// Nothing where the program came to its end. The scanner stands at the block of the end.
void reportEnd(const std::string& path, const frontend::nc::Scanner& scanner, const sim::Machine& machine,
               Session& session);
// The same of a program that was loaded, and what the run found besides.
void reportRun(const sim::Run& run, const sim::Machine& machine, Session& session);
// The last lines of the trace: what was written.
void traceVariables(const sim::Machine& machine, sim::Trace& trace);
// docs/sim.md says what is in it. `run`: of a program that was loaded; nullptr: of plain blocks.
std::string summary(sim::Machine& machine, const sim::Run* run, Session& session);

} // namespace dotek::driver
