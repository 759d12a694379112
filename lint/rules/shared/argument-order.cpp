#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(argument_order) = programRule<macrob::argumentOrderCheck>();

} // namespace dotek::lint::rule
