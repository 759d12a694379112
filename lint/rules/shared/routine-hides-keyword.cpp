#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(routine_hides_keyword) = progRule<compost::routineHidesKeywordCheck>();

} // namespace dotek::lint::rule
