#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(unknown_command) = fileRule<gibbs::unknownCommandCheck>();

} // namespace dotek::lint::rule
