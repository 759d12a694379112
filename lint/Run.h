// Runs rules.
#pragma once

#include "lint/Project.h"

#include <functional>

namespace dotek::lint {

// Runs the rules for which `wanted` holds: first those that look at one NC program by itself, program by
// program, then those that look at all inputs.
void runRules(const Project& project, Diagnostics& diagnostics,
              const std::function<bool(const NamedRule&)>& wanted);

} // namespace dotek::lint
