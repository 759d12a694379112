#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(comment_brace) = progRule<compost::commentBraceCheck>();

} // namespace dotek::lint::rule
