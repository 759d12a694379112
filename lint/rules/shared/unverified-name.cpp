#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(unverified_name) = fileRule<gibbs::unverifiedNameCheck>();

} // namespace dotek::lint::rule
