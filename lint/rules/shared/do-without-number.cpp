#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(do_without_number) = programRule<macrob::doWithoutNumberCheck>();

} // namespace dotek::lint::rule
