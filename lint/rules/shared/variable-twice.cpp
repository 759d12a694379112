#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(variable_twice) = fileRule<gibbs::variableTwiceCheck>();

} // namespace dotek::lint::rule
