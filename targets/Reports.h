// Reports of the cycle language, for targets that print none.
#pragma once

#include "project/Lowering.h"
#include "support/Source.h"

#include <optional>

namespace dotek::targets {

// Takes the reports out, each with the comment that names it, then what is left without a purpose: branches
// that only led to one, and parameters with a default that only chose them, which get it. Not of a cycle that
// calls programs: these read its parameters. The place of the first report; nothing: there is none.
std::optional<SourceRange> dropReports(project::LoweredCycle& lowered);

} // namespace dotek::targets
