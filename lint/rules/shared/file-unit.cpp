#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(file_unit) = fileRule<gibbs::fileUnitCheck>();

} // namespace dotek::lint::rule
