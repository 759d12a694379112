// Runs rules.
#pragma once

#include "lint/Project.h"

#include <functional>

namespace dotek::lint {

// Runs the rules for which `wanted` holds: those that look at one NC program as it was parsed, those that
// look at one by itself after lowering, and those that look at all inputs; of much text on two threads, with
// the same findings. Those of shared rules go to `shared`, of the others to `separate`.
void runRules(const Project& project, Diagnostics& shared, Diagnostics& separate,
              const std::function<bool(const NamedRule&)>& wanted);

// Adds what was found apart, as if it had been found there.
void moveInto(Diagnostics& to, Diagnostics& from);

} // namespace dotek::lint
