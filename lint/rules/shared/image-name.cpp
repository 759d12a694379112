#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(image_name) = fileRule<gibbs::imageNameCheck>();

} // namespace dotek::lint::rule
