// Private to Sim.cpp: how a run ended, as diagnostics and as JSON.
#pragma once

#include "driver/Session.h"
#include "frontend/nc/Scan.h"
#include "sim/Machine.h"

#include <string>

namespace dotek::driver {

void reportScanError(const std::string& path, const frontend::nc::Scanner& scanner, const LineChunks& chunks,
                     Session& session);
// Nothing where the program came to its end. The scanner stands at the block of the end.
void reportEnd(const std::string& path, const frontend::nc::Scanner& scanner, const sim::Machine& machine,
               Session& session);
// docs/sim.md says what is in it.
std::string summary(sim::Machine& machine, const stdlib::Control& control, Session& session);

} // namespace dotek::driver
