#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(next_without_for) = fileRule<gibbs::nextWithoutForCheck>();

} // namespace dotek::lint::rule
