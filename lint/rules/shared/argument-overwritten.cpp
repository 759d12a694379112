#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(argument_overwritten) = programRule<macrob::argumentOverwrittenCheck>();

} // namespace dotek::lint::rule
