#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(unverified_in_prog) = progRule<compost::unverifiedInProgCheck>();

} // namespace dotek::lint::rule
