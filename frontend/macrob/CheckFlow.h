// Loops, jumps and dead blocks of one program. Private to the checks.
#pragma once

#include "frontend/macrob/Check.h"

namespace dotek::frontend::macrob {

FlowFindings flowOf(const Program& program, const SourceMap& sources);

} // namespace dotek::frontend::macrob
