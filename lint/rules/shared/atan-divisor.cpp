#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(atan_divisor) = programRule<macrob::atanDivisorCheck>();

} // namespace dotek::lint::rule
