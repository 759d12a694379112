#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(alarm_without_text) = programRule<macrob::alarmWithoutTextCheck>();

} // namespace dotek::lint::rule
