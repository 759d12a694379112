#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(point_lost) = programRule<macrob::pointLostCheck>();

} // namespace dotek::lint::rule
