#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(unknown_function) = fileRule<gibbs::unknownFunctionCheck>();

} // namespace dotek::lint::rule
