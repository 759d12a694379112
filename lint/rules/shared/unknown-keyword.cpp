#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(unknown_keyword) = progRule<compost::unknownKeywordCheck>();

} // namespace dotek::lint::rule
