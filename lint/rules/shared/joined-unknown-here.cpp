#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(joined_unknown_here) = programRule<macrob::joinedUnknownHereCheck>();

} // namespace dotek::lint::rule
