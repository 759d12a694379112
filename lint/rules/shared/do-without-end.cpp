#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(do_without_end) = programRule<macrob::doWithoutEndCheck>();

} // namespace dotek::lint::rule
