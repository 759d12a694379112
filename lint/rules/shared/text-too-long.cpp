#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(text_too_long) = fileRule<gibbs::textTooLongCheck>();

} // namespace dotek::lint::rule
