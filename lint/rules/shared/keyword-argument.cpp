#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(keyword_argument) = progRule<compost::keywordArgumentCheck>();

} // namespace dotek::lint::rule
