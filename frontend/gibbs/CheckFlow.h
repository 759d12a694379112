// Labels, GOTO, FOR and NEXT of one macro. Private to the checks.
#pragma once

#include "frontend/gibbs/Check.h"

#include <vector>

namespace dotek::frontend::gibbs {

FlowFindings flowOf(const Macro& macro, const std::vector<const Macro*>& included,
                    const ParseContext& context);

} // namespace dotek::frontend::gibbs
