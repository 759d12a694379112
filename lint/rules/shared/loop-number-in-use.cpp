#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(loop_number_in_use) = programRule<macrob::loopNumberInUseCheck>();

} // namespace dotek::lint::rule
