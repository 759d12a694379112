#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(jump_into_loop) = programRule<macrob::jumpIntoLoopCheck>();

} // namespace dotek::lint::rule
