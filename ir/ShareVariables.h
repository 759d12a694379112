// Fewer variables, for targets that have few.
#pragma once

#include "ir/Cycle.h"

#include <cstdint>

namespace dotek::ir {

// How many variables it takes to become one.
enum class Sharing : std::uint8_t {
  Locals, // of one kind
  // Also lengths, angles, numbers and flags with one another, and with parameters that nothing needs any
  // more. Copies of what never changes are gone, and what is computed for nothing.
  Arguments,
};

// Locals that alone the body knows, and whose values are never needed at the same time, become one, under the
// name of the first, or of the parameter. The values of all expressions stay. One that some path reads before
// it is assigned stays by itself. Variables keep their ids; those of the others are used no more.
void shareVariables(Cycle& cycle, Sharing sharing = Sharing::Locals);

} // namespace dotek::ir
