#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(read_only_written) = programRule<macrob::readOnlyWrittenCheck>();

} // namespace dotek::lint::rule
