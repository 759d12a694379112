#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(brackets_too_deep) = programRule<macrob::bracketsTooDeepCheck>();

} // namespace dotek::lint::rule
