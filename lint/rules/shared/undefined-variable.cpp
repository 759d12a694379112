#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(undefined_variable) = cycleRule<gibbs::undefinedVariableCheck>();

} // namespace dotek::lint::rule
