#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(end_without_do) = programRule<macrob::endWithoutDoCheck>();

} // namespace dotek::lint::rule
