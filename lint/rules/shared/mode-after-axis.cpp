#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(mode_after_axis) = programRule<macrob::modeAfterAxisCheck>();

} // namespace dotek::lint::rule
