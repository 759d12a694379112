#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(hash_missing) = programRule<macrob::hashMissingCheck>();

} // namespace dotek::lint::rule
