#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(keyword_case) = progRule<compost::keywordCaseCheck>();

} // namespace dotek::lint::rule
