#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(system_variable_unknown) = programRule<macrob::systemVariableUnknownCheck>();

} // namespace dotek::lint::rule
