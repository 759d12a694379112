#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(control_twice) = fileRule<gibbs::controlTwiceCheck>();

} // namespace dotek::lint::rule
