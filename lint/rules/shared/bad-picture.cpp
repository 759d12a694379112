#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(bad_picture) = progRule<compost::badPictureCheck>();

} // namespace dotek::lint::rule
