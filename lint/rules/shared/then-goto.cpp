#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(then_goto) = programRule<macrob::thenGotoCheck>();

} // namespace dotek::lint::rule
