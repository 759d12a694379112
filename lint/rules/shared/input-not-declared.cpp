#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(input_not_declared) = cycleRule<gibbs::inputNotDeclaredCheck>();

} // namespace dotek::lint::rule
