#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(renamed_command) = fileRule<gibbs::renamedCommandCheck>();

} // namespace dotek::lint::rule
