#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(equality_of_computed) = programRule<macrob::equalityOfComputedCheck>();

} // namespace dotek::lint::rule
