#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(constant_condition) = programRule<macrob::constantConditionCheck>();

} // namespace dotek::lint::rule
