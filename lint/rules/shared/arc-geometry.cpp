#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(arc_geometry) = programRule<macrob::arcGeometryCheck>();

} // namespace dotek::lint::rule
