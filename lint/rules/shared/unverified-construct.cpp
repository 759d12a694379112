#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(unverified_construct) = fileRule<gibbs::unverifiedConstructCheck>();

} // namespace dotek::lint::rule
