#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(block_never_runs) = programRule<macrob::blockNeverRunsCheck>();

} // namespace dotek::lint::rule
