#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(codes_exclude) = programRule<macrob::codesExcludeCheck>();

} // namespace dotek::lint::rule
