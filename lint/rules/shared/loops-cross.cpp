#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(loops_cross) = programRule<macrob::loopsCrossCheck>();

} // namespace dotek::lint::rule
