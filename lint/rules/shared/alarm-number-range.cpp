#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(alarm_number_range) = programRule<macrob::alarmNumberRangeCheck>();

} // namespace dotek::lint::rule
