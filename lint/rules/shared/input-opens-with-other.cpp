#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(input_opens_with_other) = cycleRule<gibbs::inputOpensWithOtherCheck>();

} // namespace dotek::lint::rule
