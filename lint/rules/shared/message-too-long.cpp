#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(message_too_long) = programRule<macrob::messageTooLongCheck>();

} // namespace dotek::lint::rule
