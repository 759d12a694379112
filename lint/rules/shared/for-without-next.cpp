#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(for_without_next) = fileRule<gibbs::forWithoutNextCheck>();

} // namespace dotek::lint::rule
