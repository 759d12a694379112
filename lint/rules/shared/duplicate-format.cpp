#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(duplicate_format) = progRule<compost::duplicateFormatCheck>();

} // namespace dotek::lint::rule
