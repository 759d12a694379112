#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(null_written) = programRule<macrob::nullWrittenCheck>();

} // namespace dotek::lint::rule
