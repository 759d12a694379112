#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(return_repeated) = programRule<macrob::returnRepeatedCheck>();

} // namespace dotek::lint::rule
