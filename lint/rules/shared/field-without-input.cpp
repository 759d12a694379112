#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(field_without_input) = cycleRule<gibbs::fieldWithoutInputCheck>();

} // namespace dotek::lint::rule
