#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(continue_outside_for) = fileRule<gibbs::continueOutsideForCheck>();

} // namespace dotek::lint::rule
