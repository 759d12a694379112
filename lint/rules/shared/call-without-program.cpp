#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(call_without_program) = programRule<macrob::callWithoutProgramCheck>();

} // namespace dotek::lint::rule
