#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(loop_number_range) = programRule<macrob::loopNumberRangeCheck>();

} // namespace dotek::lint::rule
