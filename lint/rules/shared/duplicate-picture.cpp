#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(duplicate_picture) = progRule<compost::duplicatePictureCheck>();

} // namespace dotek::lint::rule
