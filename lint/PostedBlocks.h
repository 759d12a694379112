// What a post prints, as rules of NC programs look at it.
#pragma once

#include "lint/Project.h"

#include <functional>

namespace dotek::lint {

// Posts each cycle with its first values and runs those rules for programs on the blocks which hold whatever
// the values and the caller are. Findings are at the lines of the Prog. Cycles that do not post, or whose
// control the form does not name, are passed over: others say why.
void lintPosted(const Project& project, Diagnostics& diagnostics,
                const std::function<bool(const NamedRule&)>& wanted);

} // namespace dotek::lint
