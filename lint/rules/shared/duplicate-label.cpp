#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(duplicate_label) = fileRule<gibbs::duplicateLabelCheck>();

} // namespace dotek::lint::rule
