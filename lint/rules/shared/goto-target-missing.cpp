#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(goto_target_missing) = programRule<macrob::gotoTargetMissingCheck>();

} // namespace dotek::lint::rule
