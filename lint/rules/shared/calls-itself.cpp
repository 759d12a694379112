#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(calls_itself) = programRule<macrob::callsItselfCheck>();

} // namespace dotek::lint::rule
