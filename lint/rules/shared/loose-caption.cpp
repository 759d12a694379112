#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(loose_caption) = fileRule<gibbs::looseCaptionCheck>();

} // namespace dotek::lint::rule
