#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(end_without_number) = programRule<macrob::endWithoutNumberCheck>();

} // namespace dotek::lint::rule
