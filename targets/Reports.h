// Reports of the cycle language, for targets that print none.
#pragma once

#include "ir/Cycle.h"
#include "support/Source.h"

#include <optional>

namespace dotek::targets {

// Takes the reports out, each with the comment that names it, and the branches that only led to one. The
// parameters that chose them stay: a caller may give them. The place of the first report; nothing: there is
// none.
std::optional<SourceRange> dropReports(ir::Cycle& cycle);

} // namespace dotek::targets
