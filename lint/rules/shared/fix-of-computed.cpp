#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(fix_of_computed) = programRule<macrob::fixOfComputedCheck>();

} // namespace dotek::lint::rule
