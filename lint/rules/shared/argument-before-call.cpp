#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(argument_before_call) = programRule<macrob::argumentBeforeCallCheck>();

} // namespace dotek::lint::rule
