#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(function_unknown_here) = programRule<macrob::functionUnknownHereCheck>();

} // namespace dotek::lint::rule
