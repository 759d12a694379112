#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(no_argument) = programRule<macrob::noArgumentCheck>();

} // namespace dotek::lint::rule
