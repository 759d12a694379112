#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(unknown_control) = fileRule<gibbs::unknownControlCheck>();

} // namespace dotek::lint::rule
