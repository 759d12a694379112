#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(picture_unused) = progRule<compost::pictureUnusedCheck>();

} // namespace dotek::lint::rule
