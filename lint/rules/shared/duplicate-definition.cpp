#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(duplicate_definition) = fileRule<gibbs::duplicateDefinitionCheck>();

} // namespace dotek::lint::rule
