#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(signal_value) = programRule<macrob::signalValueCheck>();

} // namespace dotek::lint::rule
