#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(routine_never_called) = progRule<compost::routineNeverCalledCheck>();

} // namespace dotek::lint::rule
