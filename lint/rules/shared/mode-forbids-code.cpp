#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(mode_forbids_code) = programRule<macrob::modeForbidsCodeCheck>();

} // namespace dotek::lint::rule
