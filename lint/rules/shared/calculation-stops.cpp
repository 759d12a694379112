#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(calculation_stops) = programRule<macrob::calculationStopsCheck>();

} // namespace dotek::lint::rule
