#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(then_unknown_here) = programRule<macrob::thenUnknownHereCheck>();

} // namespace dotek::lint::rule
