#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(argument_kind) = fileRule<gibbs::argumentKindCheck>();

} // namespace dotek::lint::rule
