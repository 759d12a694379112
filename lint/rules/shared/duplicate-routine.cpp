#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(duplicate_routine) = progRule<compost::duplicateRoutineCheck>();

} // namespace dotek::lint::rule
