#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(dialog_without_ok) = fileRule<gibbs::dialogWithoutOkCheck>();

} // namespace dotek::lint::rule
