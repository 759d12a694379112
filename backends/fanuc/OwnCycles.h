// Cycles by name that no macro carries out (ir/CycleNames.h).
#pragma once

#include "backends/fanuc/State.h"

namespace dotek::backends::fanuc {

// Writes such a cycle, or refuses it. false: it is the call of a macro.
bool writeOwnCycle(State& state, const ir::CallCycle& cycle, const ir::Origin& origin);
// Sets the offsets of a kSetOffset by the values that the program has computed.
void writeSetOffset(State& state, const ir::CallCycle& set, const ir::Origin& origin);

} // namespace dotek::backends::fanuc
