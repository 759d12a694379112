#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(too_many_names) = fileRule<gibbs::tooManyNamesCheck>();

} // namespace dotek::lint::rule
