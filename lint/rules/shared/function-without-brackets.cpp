#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(function_without_brackets) = programRule<macrob::functionWithoutBracketsCheck>();

} // namespace dotek::lint::rule
