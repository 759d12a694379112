// Runs rules.
#pragma once

#include "lint/Project.h"

#include <functional>

namespace dotek::lint {

// Runs the rules for which `wanted` holds: those that look at one NC program as it was parsed, those that
// look at one by itself after lowering, program by program, and those that look at all inputs. Findings of
// shared rules go to `shared`, of the others to `separate`; in what order depends on nothing but the rules of
// one code.
void runRules(const Project& project, Diagnostics& shared, Diagnostics& separate,
              const std::function<bool(const NamedRule&)>& wanted);

} // namespace dotek::lint
