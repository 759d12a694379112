#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(next_of_other_for) = fileRule<gibbs::nextOfOtherForCheck>();

} // namespace dotek::lint::rule
