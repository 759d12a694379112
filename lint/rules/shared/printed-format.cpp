#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(printed_format) = programRule<macrob::printedFormatCheck>();

} // namespace dotek::lint::rule
