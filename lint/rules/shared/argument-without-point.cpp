#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(argument_without_point) = programRule<macrob::argumentWithoutPointCheck>();

} // namespace dotek::lint::rule
