#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(feed_missing) = programRule<macrob::feedMissingCheck>();

} // namespace dotek::lint::rule
