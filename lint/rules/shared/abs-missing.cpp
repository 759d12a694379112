#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(abs_missing) = programRule<macrob::absMissingCheck>();

} // namespace dotek::lint::rule
