#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(code_with_point) = programRule<macrob::codeWithPointCheck>();

} // namespace dotek::lint::rule
