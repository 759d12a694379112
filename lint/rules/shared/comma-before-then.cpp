#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(comma_before_then) = fileRule<gibbs::commaBeforeThenCheck>();

} // namespace dotek::lint::rule
