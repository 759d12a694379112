#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(keyword_kind) = progRule<compost::keywordKindCheck>();

} // namespace dotek::lint::rule
