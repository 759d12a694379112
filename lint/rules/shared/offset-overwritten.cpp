#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(offset_overwritten) = programRule<macrob::offsetOverwrittenCheck>();

} // namespace dotek::lint::rule
