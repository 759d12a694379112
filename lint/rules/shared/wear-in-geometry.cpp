#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(wear_in_geometry) = programRule<macrob::wearInGeometryCheck>();

} // namespace dotek::lint::rule
