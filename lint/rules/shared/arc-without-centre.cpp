#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(arc_without_centre) = programRule<macrob::arcWithoutCentreCheck>();

} // namespace dotek::lint::rule
