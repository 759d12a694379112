#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(argument_count) = fileRule<gibbs::argumentCountCheck>();

} // namespace dotek::lint::rule
