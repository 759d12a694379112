#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(undefined_label) = fileRule<gibbs::undefinedLabelCheck>();

} // namespace dotek::lint::rule
