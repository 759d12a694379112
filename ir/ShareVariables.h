// Fewer variables, for targets that have few.
#pragma once

#include "ir/Cycle.h"

namespace dotek::ir {

// Locals of one kind that alone the body knows, and whose values are never needed at the same time, become
// one, under the name of the first. The values of all expressions stay. One that some path reads before it is
// assigned stays by itself. Variables keep their ids; those of the others are used no more.
void shareVariables(Cycle& cycle);

} // namespace dotek::ir
