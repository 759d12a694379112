#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(flag_never_set) = progRule<compost::flagNeverSetCheck>();

} // namespace dotek::lint::rule
