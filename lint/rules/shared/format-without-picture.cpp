#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(format_without_picture) = progRule<compost::formatWithoutPictureCheck>();

} // namespace dotek::lint::rule
