// How the run of a cycle ended: as diagnostics, as lines of the trace, as JSON.
#pragma once

#include "sim/cycle/CycleRun.h"
#include "sim/machine/Measurement.h"
#include "sim/machine/Trace.h"
#include "sim/run/SimWorld.h"

#include <string>

namespace dotek::sim {

// Nothing where the cycle came to its end.
void reportCycle(const CycleRun& run, const Machine& machine, Session& session);
// The results that have a value, in the order of their declarations. Without any: no values.
Measurement resultsOf(const ir::Cycle& cycle, const CycleRun& run);
// "result size 30.020000": the last lines of the trace.
void traceResults(const CycleRun& run, Trace& trace);
// docs/sim.md says what is in it.
std::string cycleSummary(const ir::Cycle& cycle, const CycleRun& run, const Machine& machine,
                         const SimWorld& world, Session& session);

} // namespace dotek::sim
