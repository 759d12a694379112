#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(dialog_without_cancel) = fileRule<gibbs::dialogWithoutCancelCheck>();

} // namespace dotek::lint::rule
