#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(position_read_early) = programRule<macrob::positionReadEarlyCheck>();

} // namespace dotek::lint::rule
