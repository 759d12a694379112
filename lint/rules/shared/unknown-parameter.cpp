#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(unknown_parameter) = fileRule<gibbs::unknownParameterCheck>();

} // namespace dotek::lint::rule
