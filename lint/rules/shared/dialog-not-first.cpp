#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(dialog_not_first) = fileRule<gibbs::dialogNotFirstCheck>();

} // namespace dotek::lint::rule
