#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(subscript_as_value) = programRule<macrob::subscriptAsValueCheck>();

} // namespace dotek::lint::rule
