#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(variable_out_of_range) = programRule<macrob::variableOutOfRangeCheck>();

} // namespace dotek::lint::rule
