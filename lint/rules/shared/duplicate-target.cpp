#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(duplicate_target) = programRule<macrob::duplicateTargetCheck>();

} // namespace dotek::lint::rule
