#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(field_value) = fileRule<gibbs::fieldValueCheck>();

} // namespace dotek::lint::rule
